// Multiprecision scalars: floating-point numbers of 50 and more decimal digits.
//
// Their arithmetic is that of Boost.Multiprecision's cpp_bin_float without expression templates, bit for bit. It is
// compiled once, in base/multiprecision.cpp. Before, each file that instantiates a template for these numbers included
// Boost and inlined its arithmetic, which took two thirds of the compile time.
#pragma once

#include <Eigen/Core>

#include <compare>
#include <concepts>
#include <cstddef>
#include <ios>
#include <iosfwd>
#include <limits>
#include <string>
#include <type_traits>

// Calls F(name) for the functions of <cmath> that a BigFloat has.
#define IRK_BIG_FLOAT_FUNCTIONS(F) IRK_POWERS(F) IRK_ANGLES(F) IRK_HYPERBOLIC(F) IRK_ROUNDED(F)
#define IRK_POWERS(F) F(sqrt) F(cbrt) F(exp) F(expm1) F(log) F(log1p) F(log2) F(log10)
#define IRK_ANGLES(F) F(sin) F(cos) F(tan) F(asin) F(acos) F(atan)
#define IRK_HYPERBOLIC(F) F(sinh) F(cosh) F(tanh) F(asinh) F(acosh) F(atanh)
#define IRK_ROUNDED(F) F(abs) F(fabs) F(floor) F(ceil) F(round) F(trunc)
#define IRK_BIG_FLOAT_FUNCTIONS_OF_TWO(F) F(pow) F(atan2) F(hypot) F(fmod)

namespace irk {

/// A binary floating-point number that holds Digits decimal digits: 50, 80, 100 or 130. Operations round to nearest.
///
/// Arithmetic types convert to it implicitly and exactly; all other conversions are explicit and round to nearest,
/// those to integers towards zero. NaN compares as unordered. The functions of <cmath> below are found by argument
/// dependent lookup: `using std::sin; sin(x)`.
template <int Digits>
class BigFloat {
 public:
  BigFloat() noexcept;  ///< 0
  BigFloat(const BigFloat& other) noexcept;
  BigFloat& operator=(const BigFloat& other) noexcept;  // NOLINT(bugprone-unhandled-self-assignment)
  BigFloat(double value) noexcept;                      // NOLINT(google-explicit-constructor)
  BigFloat(long long value) noexcept;                   // NOLINT(google-explicit-constructor)
  BigFloat(unsigned long long value) noexcept;          // NOLINT(google-explicit-constructor)
  template <std::signed_integral I>
  BigFloat(I value) noexcept  // NOLINT(google-explicit-constructor)
      : BigFloat(static_cast<long long>(value)) {}
  template <std::unsigned_integral I>
  BigFloat(I value) noexcept  // NOLINT(google-explicit-constructor)
      : BigFloat(static_cast<unsigned long long>(value)) {}

  /// The number that is nearest to a decimal text. Throws std::runtime_error if the text is not a number.
  explicit BigFloat(const char* text);
  explicit BigFloat(const std::string& text) : BigFloat(text.c_str()) {}

  template <int Other>
  requires(Other != Digits) explicit BigFloat(const BigFloat<Other>& other);

  explicit operator double() const;
  explicit operator long long() const;  ///< the nearest limit for numbers out of range
  template <std::integral I>
  explicit operator I() const {
    return static_cast<I>(static_cast<long long>(*this));
  }

  BigFloat& operator+=(const BigFloat& b);
  BigFloat& operator-=(const BigFloat& b);
  BigFloat& operator*=(const BigFloat& b);
  BigFloat& operator/=(const BigFloat& b);
  BigFloat operator-() const;
  BigFloat operator+() const { return *this; }

  friend BigFloat operator+(const BigFloat& a, const BigFloat& b) { return sum(a, b); }
  friend BigFloat operator-(const BigFloat& a, const BigFloat& b) { return difference(a, b); }
  friend BigFloat operator*(const BigFloat& a, const BigFloat& b) { return product(a, b); }
  friend BigFloat operator/(const BigFloat& a, const BigFloat& b) { return quotient(a, b); }
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
  template <std::integral I>
  friend BigFloat pow(const BigFloat& x, I n) {
    return powerOf(x, n);
  }
  friend BigFloat ldexp(const BigFloat& x, int n) { return ldexpOf(x, n); }
  friend BigFloat frexp(const BigFloat& x, int* n) { return frexpOf(x, n); }
  friend bool isfinite(const BigFloat& x) { return x.isFinite(); }
  friend bool isnan(const BigFloat& x) { return x.isNan(); }
  friend bool isinf(const BigFloat& x) { return !x.isFinite() && !x.isNan(); }
  friend bool signbit(const BigFloat& x) { return x.isNegative(); }
  friend std::ostream& operator<<(std::ostream& out, const BigFloat& x) { return x.write(out); }
  friend std::istream& operator>>(std::istream& in, BigFloat& x) { return x.read(in); }

  /// The decimal text with `digits` digits, all of them if 0, in the format of a stream with these flags.
  std::string str(std::streamsize digits = 0, std::ios_base::fmtflags flags = {}) const;

 private:
  friend struct BigFloatValue;

  static BigFloat sum(const BigFloat& a, const BigFloat& b);
  static BigFloat difference(const BigFloat& a, const BigFloat& b);
  static BigFloat product(const BigFloat& a, const BigFloat& b);
  static BigFloat quotient(const BigFloat& a, const BigFloat& b);
  static std::partial_ordering order(const BigFloat& a, const BigFloat& b);
#define IRK_MEMBER(name) static BigFloat name##Of(const BigFloat& x);
  IRK_BIG_FLOAT_FUNCTIONS(IRK_MEMBER)
#undef IRK_MEMBER
#define IRK_MEMBER(name) static BigFloat name##Of(const BigFloat& x, const BigFloat& y);
  IRK_BIG_FLOAT_FUNCTIONS_OF_TWO(IRK_MEMBER)
#undef IRK_MEMBER
  static BigFloat powerOf(const BigFloat& x, long long n);
  static BigFloat ldexpOf(const BigFloat& x, int n);
  static BigFloat frexpOf(const BigFloat& x, int* n);
  bool isFinite() const;
  bool isNan() const;
  bool isNegative() const;
  std::ostream& write(std::ostream& out) const;
  std::istream& read(std::istream& in);

  // Holds Boost's number; the source file checks size and alignment.
  static constexpr std::size_t kBytes = Digits <= 50 ? 64 : Digits <= 100 ? 80 : 96;
  alignas(16) std::byte value_[kBytes];
};

/// 50 decimal digits.
using mp50 = BigFloat<50>;

/// 100 decimal digits, for measuring orders from about 20 on: only errors below 1e-40 show them as a straight line.
using mp100 = BigFloat<100>;

}  // namespace irk

template <int Digits>
struct std::numeric_limits<irk::BigFloat<Digits>> {  // NOLINTBEGIN(readability-identifier-naming): prescribed
  using Number = irk::BigFloat<Digits>;
  static constexpr bool is_specialized = true, is_signed = true, is_integer = false, is_exact = false;
  static constexpr bool has_infinity = true, has_quiet_NaN = true, has_signaling_NaN = false;
  static constexpr bool is_bounded = true, is_modulo = false, is_iec559 = false, has_denorm_loss = false;
  static constexpr bool traps = false, tinyness_before = false;
  static constexpr std::float_denorm_style has_denorm = std::denorm_absent;
  static constexpr std::float_round_style round_style = std::round_to_nearest;
  static constexpr int digits = Digits * 1000 / 301 + 2, digits10 = Digits, max_digits10 = Digits + 3, radix = 2;
  static constexpr int min_exponent = -2147482000, max_exponent = 2147482000;
  static constexpr int min_exponent10 = -646392000, max_exponent10 = 646392000;
  static Number epsilon();
  static Number min();
  static Number max();
  static Number lowest();
  static Number infinity();
  static Number quiet_NaN();
  static Number signaling_NaN() { return Number(); }
  static Number denorm_min() { return min(); }
  static Number round_error() { return Number(0.5); }
};

// Eigen's costs are those that Boost gives for its numbers.
template <int Digits>
struct Eigen::NumTraits<irk::BigFloat<Digits>> : GenericNumTraits<irk::BigFloat<Digits>> {
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
  static irk::BigFloat<Digits> dummy_precision() {
    return 1000 * std::numeric_limits<irk::BigFloat<Digits>>::epsilon();
  }
  static int digits10() { return Digits; }
};  // NOLINTEND(readability-identifier-naming)

template <int Digits, class T, class Operation>
requires std::is_arithmetic_v<T>
struct Eigen::ScalarBinaryOpTraits<irk::BigFloat<Digits>, T, Operation> {
  using ReturnType = irk::BigFloat<Digits>;
};
template <int Digits, class T, class Operation>
requires std::is_arithmetic_v<T>
struct Eigen::ScalarBinaryOpTraits<T, irk::BigFloat<Digits>, Operation> {
  using ReturnType = irk::BigFloat<Digits>;
};

/// Instantiates the class template Name for every scalar that core is compiled for.
#define IRK_INSTANTIATE_CLASS(Name) \
  template class Name<double>;      \
  template class Name<::irk::mp50>; \
  template class Name<::irk::mp100>;
