// A multiprecision scalar: a binary floating-point number whose decimal digits are chosen at run time.
//
// Arithmetic and functions are those of MPFR (Fousse, Hanrot, Lefevre, Pelissier, Zimmermann, ACM TOMS 33, 2007):
// every result is the exact one, rounded to nearest. Numbers of up to 150 digits hold their bits inside, without
// memory of their own.
#pragma once

#include <Eigen/Core>

#include <compare>
#include <concepts>
#include <ios>
#include <iosfwd>
#include <limits>
#include <string>
#include <type_traits>

// Calls F(name) for the functions of <cmath> that a BigFloat has.
#define IRK_BIG_FLOAT_FUNCTIONS(F) IRK_POWERS(F) IRK_ANGLES(F) IRK_HYPERBOLIC(F) IRK_TO_INTEGERS(F) F(abs)
#define IRK_POWERS(F) F(sqrt) F(cbrt) F(exp) F(expm1) F(log) F(log1p) F(log2) F(log10)
#define IRK_ANGLES(F) F(sin) F(cos) F(tan) F(asin) F(acos) F(atan)
#define IRK_HYPERBOLIC(F) F(sinh) F(cosh) F(tanh) F(asinh) F(acosh) F(atanh)
#define IRK_TO_INTEGERS(F) F(floor) F(ceil) F(round) F(trunc)
#define IRK_BIG_FLOAT_OPERATIONS(F) F(add) F(sub) F(mul) F(div)
#define IRK_BIG_FLOAT_FUNCTIONS_OF_TWO(F) F(pow) F(atan2) F(hypot) F(fmod)

namespace irk {

/// Sets the decimal digits of all results of BigFloat's operations on this thread while the object lives; without one
/// they are 50. A parallel region starts with the default: pass `now()` on to its threads.
class WorkingDigits {
 public:
  /// A double has up to 17 digits. 2000 are twice the digits that a run may have: block forms are made with twice.
  static constexpr int kLeast = 17, kDefault = 50, kMost = 2000;

  /// Throws Misuse for digits outside of kLeast .. kMost.
  explicit WorkingDigits(int digits);
  ~WorkingDigits();
  WorkingDigits(const WorkingDigits&) = delete;
  WorkingDigits& operator=(const WorkingDigits&) = delete;

  static int now();

 private:
  int before_;
};

/// Operations round to nearest, to the WorkingDigits of their thread; copies keep all bits that a number has.
///
/// Arithmetic types convert to it implicitly and exactly; all other conversions are explicit and round to nearest,
/// those to integers towards zero. NaN compares as unordered. The functions of <cmath> below are found by argument
/// dependent lookup: `using std::sin; sin(x)`.
class BigFloat {
 public:
  BigFloat() noexcept = default;  ///< 0
  BigFloat(const BigFloat& other);
  BigFloat(BigFloat&& other) noexcept;
  BigFloat& operator=(const BigFloat& other);
  BigFloat& operator=(BigFloat&& other) noexcept;
  ~BigFloat() {
    if (limbs_ > kInside) release();
  }
  BigFloat(double value);              // NOLINT(google-explicit-constructor)
  BigFloat(long long value);           // NOLINT(google-explicit-constructor)
  BigFloat(unsigned long long value);  // NOLINT(google-explicit-constructor)
  template <std::signed_integral I>
  BigFloat(I value)  // NOLINT(google-explicit-constructor)
      : BigFloat(static_cast<long long>(value)) {}
  template <std::unsigned_integral I>
  BigFloat(I value)  // NOLINT(google-explicit-constructor)
      : BigFloat(static_cast<unsigned long long>(value)) {}

  /// The number that is nearest to a decimal text. Throws std::runtime_error if the text is not a number.
  explicit BigFloat(const char* text);
  explicit BigFloat(const std::string& text) : BigFloat(text.c_str()) {}

  explicit operator double() const;
  explicit operator long long() const;  ///< the nearest limit for numbers out of range
  template <std::integral I>
  explicit operator I() const {
    return static_cast<I>(static_cast<long long>(*this));
  }

  /// This number, rounded to the working digits.
  BigFloat rounded() const;

  BigFloat& operator+=(const BigFloat& b) { return *this = addOf(*this, b); }
  BigFloat& operator-=(const BigFloat& b) { return *this = subOf(*this, b); }
  BigFloat& operator*=(const BigFloat& b) { return *this = mulOf(*this, b); }
  BigFloat& operator/=(const BigFloat& b) { return *this = divOf(*this, b); }
  BigFloat operator-() const;
  BigFloat operator+() const { return *this; }

  friend BigFloat operator+(const BigFloat& a, const BigFloat& b) { return addOf(a, b); }
  friend BigFloat operator-(const BigFloat& a, const BigFloat& b) { return subOf(a, b); }
  friend BigFloat operator*(const BigFloat& a, const BigFloat& b) { return mulOf(a, b); }
  friend BigFloat operator/(const BigFloat& a, const BigFloat& b) { return divOf(a, b); }
  friend bool operator==(const BigFloat& a, const BigFloat& b) { return order(a, b) == 0; }
  friend std::partial_ordering operator<=>(const BigFloat& a, const BigFloat& b) { return order(a, b); }

#define IRK_FRIEND(name) \
  friend BigFloat name(const BigFloat& x) { return name##Of(x); }
  IRK_BIG_FLOAT_FUNCTIONS(IRK_FRIEND)
#undef IRK_FRIEND
#define IRK_FRIEND(name) \
  friend BigFloat name(const BigFloat& x, const BigFloat& y) { return name##Of(x, y); }
  IRK_BIG_FLOAT_FUNCTIONS_OF_TWO(IRK_FRIEND)
#undef IRK_FRIEND
  friend BigFloat fabs(const BigFloat& x) { return absOf(x); }
  template <std::integral I>
  friend BigFloat pow(const BigFloat& x, I n) {
    return powerOf(x, n);
  }
  friend BigFloat ldexp(const BigFloat& x, int n) { return ldexpOf(x, n); }
  friend BigFloat frexp(const BigFloat& x, int* n) { return frexpOf(x, n); }
  friend bool isfinite(const BigFloat& x) { return x.isFinite(); }
  friend bool isnan(const BigFloat& x) { return x.isNan(); }
  friend bool isinf(const BigFloat& x) { return !x.isFinite() && !x.isNan(); }
  friend bool signbit(const BigFloat& x) { return x.kind_ < 0; }
  friend std::ostream& operator<<(std::ostream& out, const BigFloat& x);

  /// The decimal text with `digits` digits, all of them if 0. `flags`: std::ios::scientific or std::ios::fixed, for
  /// which `digits` counts those after the point.
  std::string str(std::streamsize digits = 0, std::ios_base::fmtflags flags = {}) const;

 private:
  friend class BigFloatView;
  friend class BigFloatResult;

  using Limb = unsigned long;
  static constexpr int kInside = 8;  // limbs of 64 bits: 150 digits, three times the default

  static std::partial_ordering order(const BigFloat& a, const BigFloat& b);
#define IRK_MEMBER(name) static BigFloat name##Of(const BigFloat& x);
  IRK_BIG_FLOAT_FUNCTIONS(IRK_MEMBER)
#undef IRK_MEMBER
#define IRK_MEMBER(name) static BigFloat name##Of(const BigFloat& x, const BigFloat& y);
  IRK_BIG_FLOAT_OPERATIONS(IRK_MEMBER)
  IRK_BIG_FLOAT_FUNCTIONS_OF_TWO(IRK_MEMBER)
#undef IRK_MEMBER
  static BigFloat powerOf(const BigFloat& x, long long n);
  static BigFloat ldexpOf(const BigFloat& x, int n);
  static BigFloat frexpOf(const BigFloat& x, int* n);
  bool isFinite() const;
  bool isNan() const;
  Limb* bits();
  const Limb* bits() const;
  void reserve(int limbs);
  void release() noexcept;

  // MPFR's kind of the number with its sign (zero, regular, infinite, NaN), its exponent, and its mantissa, of which
  // only regular numbers have the bits. `limbs_` counts the places for them.
  int kind_ = kZero;
  int precision_ = 1;
  int limbs_ = 0;
  static constexpr int kZero = 2;  // the source file checks that this is MPFR's
  long exponent_ = 0;
  union {
    Limb inside_[kInside];
    Limb* outside_;
  };
};

/// A copy of a vector or matrix whose entries are rounded to the working digits; in double the same numbers.
template <class Derived>
auto roundedToWork(const Eigen::MatrixBase<Derived>& y) {
  using Number = typename Derived::Scalar;
  if constexpr (std::is_same_v<Number, BigFloat>) {
    return y.unaryExpr([](const BigFloat& x) { return x.rounded(); }).eval();
  } else {
    return y.eval();
  }
}

}  // namespace irk

template <>
struct std::numeric_limits<irk::BigFloat> {  // NOLINTBEGIN(readability-identifier-naming): prescribed
  using Number = irk::BigFloat;
  static constexpr bool is_specialized = true, is_signed = true, is_integer = false, is_exact = false;
  static constexpr bool has_infinity = true, has_quiet_NaN = true, has_signaling_NaN = false;
  static constexpr bool is_bounded = true, is_modulo = false, is_iec559 = false, has_denorm_loss = false;
  static constexpr bool traps = false, tinyness_before = false;
  static constexpr std::float_denorm_style has_denorm = std::denorm_absent;
  static constexpr std::float_round_style round_style = std::round_to_nearest;
  // 0: known at run time only; Boost.Math reads them so.
  static constexpr int digits = 0, digits10 = 0, max_digits10 = 0, radix = 2;
  static constexpr int min_exponent = -(1 << 30) + 2, max_exponent = (1 << 30) - 1;
  static constexpr int min_exponent10 = -323228496, max_exponent10 = 323228496;
  static Number epsilon();  ///< of the working digits
  static Number min();
  static Number max();
  static Number lowest();
  static Number infinity();
  static Number quiet_NaN();
  static Number signaling_NaN() { return Number(); }
  static Number denorm_min() { return min(); }
  static Number round_error() { return Number(0.5); }
};

// Eigen's costs are relative to those of double.
template <>
struct Eigen::NumTraits<irk::BigFloat> : GenericNumTraits<irk::BigFloat> {
  using Literal = double;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    ReadCost = 1,
    AddCost = 4,
    MulCost = 8,
    RequireInitialization = 1
  };
  static irk::BigFloat dummy_precision() { return 1000 * std::numeric_limits<irk::BigFloat>::epsilon(); }
  static int digits10() { return irk::WorkingDigits::now(); }
};  // NOLINTEND(readability-identifier-naming)

template <class T, class Operation>
requires std::is_arithmetic_v<T>
struct Eigen::ScalarBinaryOpTraits<irk::BigFloat, T, Operation> {
  using ReturnType = irk::BigFloat;
};
template <class T, class Operation>
requires std::is_arithmetic_v<T>
struct Eigen::ScalarBinaryOpTraits<T, irk::BigFloat, Operation> {
  using ReturnType = irk::BigFloat;
};

/// Instantiates the class template Name for every scalar that core is compiled for.
#define IRK_INSTANTIATE_CLASS(Name) \
  template class Name<double>;      \
  template class Name<::irk::BigFloat>;
