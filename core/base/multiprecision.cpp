#include "irk/multiprecision.h"

#include <mpfr.h>

#include <algorithm>
#include <climits>
#include <cstring>
#include <ostream>
#include <stdexcept>

#include "irk/misuse.h"

namespace irk {
namespace {

// The bits of a number of so many digits, as in Boost's cpp_bin_float: two guard bits.
constexpr int bitsOf(int digits) { return digits * 1000 / 301 + 2; }

constexpr int limbsOf(int bits) { return (bits + GMP_NUMB_BITS - 1) / GMP_NUMB_BITS; }

constexpr auto kRound = MPFR_RNDN;

constinit thread_local int working_digits = WorkingDigits::kDefault;

std::string formatOf(std::ios_base::fmtflags flags) {
  if (flags & std::ios_base::scientific) return "%.*RNe";
  return flags & std::ios_base::fixed ? "%.*RNf" : "%.*RNg";
}

}  // namespace

WorkingDigits::WorkingDigits(int digits) : before_(working_digits) {
  if (digits < kLeast || digits > kMost) {
    throw Misuse("digits = " + std::to_string(digits) + ": " + std::to_string(kLeast) + " .. " + std::to_string(kMost) +
                 " expected");
  }
  working_digits = digits;
}
WorkingDigits::~WorkingDigits() { working_digits = before_; }
int WorkingDigits::now() { return working_digits; }

/// A BigFloat as MPFR reads it. It is always a named object: some functions of MPFR are macros in which a temporary
/// would not live long enough.
class BigFloatView {
 public:
  BigFloatView(const BigFloat& x) {  // NOLINT(google-explicit-constructor)
    mpfr_custom_init_set(&value_, x.kind_, x.exponent_, x.precision_, const_cast<mp_limb_t*>(x.bits()));
  }
  operator mpfr_srcptr() const { return &value_; }  // NOLINT(google-explicit-constructor)

 private:
  __mpfr_struct value_;
};

/// A number that MPFR writes to, and the BigFloat that it becomes.
class BigFloatResult {
 public:
  explicit BigFloatResult(int bits = bitsOf(working_digits)) {
    number_.precision_ = bits;
    number_.reserve(limbsOf(bits));
    mpfr_custom_init_set(&value_, MPFR_ZERO_KIND, 0, bits, number_.bits());
  }
  operator mpfr_ptr() { return &value_; }  // NOLINT(google-explicit-constructor)

  BigFloat number() {
    number_.kind_ = mpfr_custom_get_kind(&value_);
    if (mpfr_regular_p(&value_)) number_.exponent_ = mpfr_custom_get_exp(&value_);
    return std::move(number_);
  }

 private:
  BigFloat number_;
  __mpfr_struct value_;
};

BigFloat::Limb* BigFloat::bits() { return limbs_ > kInside ? outside_ : inside_; }
const BigFloat::Limb* BigFloat::bits() const { return limbs_ > kInside ? outside_ : inside_; }

void BigFloat::reserve(int limbs) {
  static_assert(std::is_same_v<Limb, mp_limb_t> && std::is_same_v<decltype(exponent_), mpfr_exp_t>);
  static_assert(kZero == MPFR_ZERO_KIND);
  if (limbs <= std::max(limbs_, kInside)) return;
  release();
  outside_ = new Limb[static_cast<std::size_t>(limbs)];
  limbs_ = limbs;
}

void BigFloat::release() noexcept {
  if (limbs_ > kInside) delete[] outside_;
  limbs_ = 0;
}

BigFloat::BigFloat(const BigFloat& other) { *this = other; }
BigFloat::BigFloat(BigFloat&& other) noexcept { *this = std::move(other); }

BigFloat& BigFloat::operator=(const BigFloat& other) {
  if (this == &other) return *this;
  kind_ = other.kind_;
  exponent_ = other.exponent_;
  precision_ = other.precision_;
  if (std::abs(kind_) != MPFR_REGULAR_KIND) return *this;
  const int limbs = limbsOf(precision_);
  reserve(limbs);
  std::memcpy(bits(), other.bits(), static_cast<std::size_t>(limbs) * sizeof(Limb));
  return *this;
}

BigFloat& BigFloat::operator=(BigFloat&& other) noexcept {
  if (other.limbs_ <= kInside) return *this = other;  // copies inside, which cannot throw
  std::swap(kind_, other.kind_);
  std::swap(precision_, other.precision_);
  std::swap(exponent_, other.exponent_);
  std::swap(limbs_, other.limbs_);
  std::swap(inside_, other.inside_);  // the pointer is in the same place
  return *this;
}

BigFloat::BigFloat(double value) {
  BigFloatResult result(std::numeric_limits<double>::digits);
  mpfr_set_d(result, value, kRound);
  *this = result.number();
}
BigFloat::BigFloat(long long value) {
  BigFloatResult result(GMP_NUMB_BITS);
  mpfr_set_si(result, value, kRound);
  *this = result.number();
}
BigFloat::BigFloat(unsigned long long value) {
  BigFloatResult result(GMP_NUMB_BITS);
  mpfr_set_ui(result, value, kRound);
  *this = result.number();
}
BigFloat::BigFloat(const char* text) {
  BigFloatResult result;
  char* end = nullptr;
  mpfr_strtofr(result, text, &end, 10, kRound);
  if (end == text || *end != '\0') throw std::runtime_error("'" + std::string(text) + "' is not a number");
  *this = result.number();
}

BigFloat::operator double() const {
  const BigFloatView x(*this);
  return mpfr_get_d(x, kRound);
}
BigFloat::operator long long() const {
  if (isNan()) return LLONG_MAX;
  const BigFloatView x(*this);
  return mpfr_get_si(x, MPFR_RNDZ);
}

BigFloat BigFloat::rounded() const {
  BigFloatResult result;
  const BigFloatView x(*this);
  mpfr_set(result, x, kRound);
  return result.number();
}

BigFloat BigFloat::operator-() const {
  BigFloat result(*this);
  result.kind_ = -result.kind_;
  return result;
}

std::partial_ordering BigFloat::order(const BigFloat& a, const BigFloat& b) {
  if (a.isNan() || b.isNan()) return std::partial_ordering::unordered;
  const BigFloatView x(a), y(b);
  return mpfr_cmp(x, y) <=> 0;
}

std::string BigFloat::str(std::streamsize digits, std::ios_base::fmtflags flags) const {
  const auto count = static_cast<int>(digits > 0 ? digits : working_digits + 3);
  const BigFloatView x(*this);
  char* text = nullptr;
  mpfr_asprintf(&text, formatOf(flags).c_str(), count, static_cast<mpfr_srcptr>(x));
  const std::string result(text);
  mpfr_free_str(text);
  return result;
}

std::ostream& operator<<(std::ostream& out, const BigFloat& x) {
  return out << x.str(std::max<std::streamsize>(out.precision(), 1), out.flags());
}

#define IRK_DEFINE(name)                           \
  BigFloat BigFloat::name##Of(const BigFloat& x) { \
    BigFloatResult result;                         \
    const BigFloatView view(x);                    \
    mpfr_##name(result, view, kRound);             \
    return result.number();                        \
  }
IRK_POWERS(IRK_DEFINE)
IRK_ANGLES(IRK_DEFINE)
IRK_HYPERBOLIC(IRK_DEFINE)
IRK_DEFINE(abs)
#undef IRK_DEFINE
#define IRK_DEFINE(name)                           \
  BigFloat BigFloat::name##Of(const BigFloat& x) { \
    BigFloatResult result;                         \
    const BigFloatView view(x);                    \
    mpfr_##name(result, view);                     \
    return result.number();                        \
  }
IRK_TO_INTEGERS(IRK_DEFINE)
#undef IRK_DEFINE
#define IRK_DEFINE(name)                                              \
  BigFloat BigFloat::name##Of(const BigFloat& x, const BigFloat& y) { \
    BigFloatResult result;                                            \
    const BigFloatView first(x), second(y);                           \
    mpfr_##name(result, first, second, kRound);                       \
    return result.number();                                           \
  }
IRK_BIG_FLOAT_OPERATIONS(IRK_DEFINE)
IRK_BIG_FLOAT_FUNCTIONS_OF_TWO(IRK_DEFINE)
#undef IRK_DEFINE

BigFloat BigFloat::powerOf(const BigFloat& x, long long n) {
  BigFloatResult result;
  const BigFloatView view(x);
  mpfr_pow_si(result, view, n, kRound);
  return result.number();
}
BigFloat BigFloat::ldexpOf(const BigFloat& x, int n) {
  BigFloatResult result;
  const BigFloatView view(x);
  mpfr_mul_2si(result, view, n, kRound);
  return result.number();
}
BigFloat BigFloat::frexpOf(const BigFloat& x, int* n) {
  BigFloatResult result;
  mpfr_exp_t exponent = 0;
  const BigFloatView view(x);
  mpfr_frexp(&exponent, result, view, kRound);
  *n = static_cast<int>(exponent);
  return result.number();
}
bool BigFloat::isFinite() const {
  const int kind = std::abs(kind_);
  return kind == MPFR_REGULAR_KIND || kind == MPFR_ZERO_KIND;
}
bool BigFloat::isNan() const { return kind_ == MPFR_NAN_KIND; }

}  // namespace irk

using irk::BigFloat;
using Limits = std::numeric_limits<BigFloat>;

BigFloat Limits::epsilon() { return ldexp(BigFloat(1), 1 - irk::bitsOf(irk::WorkingDigits::now())); }
BigFloat Limits::min() { return ldexp(BigFloat(1), min_exponent - 1); }
BigFloat Limits::max() { return ldexp(1 - epsilon() / 2, max_exponent); }
BigFloat Limits::lowest() { return -max(); }
BigFloat Limits::infinity() { return {std::numeric_limits<double>::infinity()}; }
BigFloat Limits::quiet_NaN() { return {std::numeric_limits<double>::quiet_NaN()}; }
