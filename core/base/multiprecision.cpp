#include "irk/multiprecision.h"

#include <boost/multiprecision/cpp_bin_float.hpp>

#include <istream>
#include <new>
#include <ostream>
#include <type_traits>

namespace irk {

template <int Digits>
using Number = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<unsigned(Digits)>,
                                             boost::multiprecision::et_off>;

/// Boost's number inside a BigFloat.
struct BigFloatValue {
  template <int Digits, class... Arguments>
  static void make(BigFloat<Digits>& x, const Arguments&... arguments) {
    static_assert(sizeof(Number<Digits>) == BigFloat<Digits>::kBytes && alignof(Number<Digits>) <= 16);
    static_assert(std::is_trivially_destructible_v<Number<Digits>>);
    new (x.value_) Number<Digits>(arguments...);
  }
  template <int Digits>
  static Number<Digits>& in(BigFloat<Digits>& x) {
    return *std::launder(reinterpret_cast<Number<Digits>*>(x.value_));
  }
  template <int Digits>
  static const Number<Digits>& in(const BigFloat<Digits>& x) {
    return *std::launder(reinterpret_cast<const Number<Digits>*>(x.value_));
  }
};

template <int Digits>
static const Number<Digits>& in(const BigFloat<Digits>& x) {
  return BigFloatValue::in(x);
}

template <int Digits>
static BigFloat<Digits> wrapped(const Number<Digits>& value) {
  BigFloat<Digits> result;
  BigFloatValue::in(result) = value;
  return result;
}

template <int D>
BigFloat<D>::BigFloat() noexcept {
  BigFloatValue::make(*this);
}
template <int D>
BigFloat<D>::BigFloat(const BigFloat& other) noexcept {
  BigFloatValue::make(*this, in(other));
}
// Boost's assignment allows that both are the same number.
template <int D>
BigFloat<D>& BigFloat<D>::operator=(  // NOLINT(bugprone-unhandled-self-assignment)
    const BigFloat& other) noexcept {
  BigFloatValue::in(*this) = in(other);
  return *this;
}
template <int D>
BigFloat<D>::BigFloat(double value) noexcept {
  BigFloatValue::make(*this, value);
}
template <int D>
BigFloat<D>::BigFloat(long long value) noexcept {
  BigFloatValue::make(*this, value);
}
template <int D>
BigFloat<D>::BigFloat(unsigned long long value) noexcept {
  BigFloatValue::make(*this, value);
}
template <int D>
BigFloat<D>::BigFloat(const char* text) {
  BigFloatValue::make(*this, text);
}
template <int D>
template <int Other>
requires(Other != D) BigFloat<D>::BigFloat(const BigFloat<Other>& other) { BigFloatValue::make(*this, in(other)); }

template <int D>
BigFloat<D>::operator double() const {
  return static_cast<double>(in(*this));
}
template <int D>
BigFloat<D>::operator long long() const {
  return static_cast<long long>(in(*this));
}

template <int D>
BigFloat<D>& BigFloat<D>::operator+=(const BigFloat& b) {
  BigFloatValue::in(*this) += in(b);
  return *this;
}
template <int D>
BigFloat<D>& BigFloat<D>::operator-=(const BigFloat& b) {
  BigFloatValue::in(*this) -= in(b);
  return *this;
}
template <int D>
BigFloat<D>& BigFloat<D>::operator*=(const BigFloat& b) {
  BigFloatValue::in(*this) *= in(b);
  return *this;
}
template <int D>
BigFloat<D>& BigFloat<D>::operator/=(const BigFloat& b) {
  BigFloatValue::in(*this) /= in(b);
  return *this;
}
template <int D>
BigFloat<D> BigFloat<D>::operator-() const {
  BigFloat result(*this);
  BigFloatValue::in(result).backend().negate();
  return result;
}

// The result is computed in place: these four are nearly all of the work.
template <int D>
BigFloat<D> BigFloat<D>::sum(const BigFloat& a, const BigFloat& b) {
  BigFloat result;
  eval_add(BigFloatValue::in(result).backend(), in(a).backend(), in(b).backend());
  return result;
}
template <int D>
BigFloat<D> BigFloat<D>::difference(const BigFloat& a, const BigFloat& b) {
  BigFloat result;
  eval_subtract(BigFloatValue::in(result).backend(), in(a).backend(), in(b).backend());
  return result;
}
template <int D>
BigFloat<D> BigFloat<D>::product(const BigFloat& a, const BigFloat& b) {
  BigFloat result;
  eval_multiply(BigFloatValue::in(result).backend(), in(a).backend(), in(b).backend());
  return result;
}
template <int D>
BigFloat<D> BigFloat<D>::quotient(const BigFloat& a, const BigFloat& b) {
  BigFloat result;
  eval_divide(BigFloatValue::in(result).backend(), in(a).backend(), in(b).backend());
  return result;
}

template <int D>
std::partial_ordering BigFloat<D>::order(const BigFloat& a, const BigFloat& b) {
  if (isnan(a) || isnan(b)) return std::partial_ordering::unordered;
  return in(a).compare(in(b)) <=> 0;
}

template <int D>
std::string BigFloat<D>::str(std::streamsize digits, std::ios_base::fmtflags flags) const {
  return in(*this).str(digits, flags);
}

#define IRK_DEFINE(name)                                 \
  template <int D>                                       \
  BigFloat<D> BigFloat<D>::name##Of(const BigFloat& x) { \
    return wrapped<D>(Number<D>(name(in(x))));           \
  }
IRK_BIG_FLOAT_FUNCTIONS(IRK_DEFINE)
#undef IRK_DEFINE
#define IRK_DEFINE(name)                                                    \
  template <int D>                                                          \
  BigFloat<D> BigFloat<D>::name##Of(const BigFloat& x, const BigFloat& y) { \
    return wrapped<D>(Number<D>(name(in(x), in(y))));                       \
  }
IRK_BIG_FLOAT_FUNCTIONS_OF_TWO(IRK_DEFINE)
#undef IRK_DEFINE

template <int D>
BigFloat<D> BigFloat<D>::powerOf(const BigFloat& x, long long n) {
  return wrapped<D>(Number<D>(pow(in(x), n)));
}
template <int D>
BigFloat<D> BigFloat<D>::ldexpOf(const BigFloat& x, int n) {
  return wrapped<D>(Number<D>(ldexp(in(x), n)));
}
template <int D>
BigFloat<D> BigFloat<D>::frexpOf(const BigFloat& x, int* n) {
  return wrapped<D>(Number<D>(frexp(in(x), n)));
}
template <int D>
bool BigFloat<D>::isFinite() const {
  return boost::multiprecision::isfinite(in(*this));
}
template <int D>
bool BigFloat<D>::isNan() const {
  return boost::multiprecision::isnan(in(*this));
}
template <int D>
bool BigFloat<D>::isNegative() const {
  return boost::multiprecision::signbit(in(*this)) != 0;
}
template <int D>
std::ostream& BigFloat<D>::write(std::ostream& out) const {
  return out << in(*this);
}
template <int D>
std::istream& BigFloat<D>::read(std::istream& from) {
  return from >> BigFloatValue::in(*this);
}

}  // namespace irk

namespace std {
#define IRK_LIMIT(name)                                             \
  template <int D>                                                  \
  irk::BigFloat<D> numeric_limits<irk::BigFloat<D>>::name() {       \
    return irk::wrapped<D>(numeric_limits<irk::Number<D>>::name()); \
  }
IRK_LIMIT(epsilon)
IRK_LIMIT(min)
IRK_LIMIT(max)
IRK_LIMIT(lowest)
IRK_LIMIT(infinity)
IRK_LIMIT(quiet_NaN)
#undef IRK_LIMIT
}  // namespace std

#define IRK_CONVERTS(D, Other) template irk::BigFloat<D>::BigFloat(const irk::BigFloat<Other>&);
#define IRK_INSTANTIATE(D, A, B, C)                                                                            \
  static_assert(std::numeric_limits<irk::BigFloat<D>>::digits == std::numeric_limits<irk::Number<D>>::digits); \
  template class irk::BigFloat<D>;                                                                             \
  template struct std::numeric_limits<irk::BigFloat<D>>;                                                       \
  IRK_CONVERTS(D, A) IRK_CONVERTS(D, B) IRK_CONVERTS(D, C)
IRK_INSTANTIATE(50, 80, 100, 130)
IRK_INSTANTIATE(80, 50, 100, 130)
IRK_INSTANTIATE(100, 50, 80, 130)
IRK_INSTANTIATE(130, 50, 80, 100)
