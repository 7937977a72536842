// DualNumber<T, N>: a value with N directional derivatives. T is double, a multiprecision number or
// another DualNumber.
//
// One type serves for Jacobians (N = 8), for time derivatives of constraints (N = 1) and for both nested.
// Eigen's AutoDiffScalar does not: nested over a multiprecision number it rejects `double` operands,
// and its abs() mixes int with the scalar. DualNumber has no expression templates, so that `auto` is
// safe in a user's residual.
// Functions: abs, fabs, sqrt, cbrt, pow, hypot, exp, expm1, log, log1p, sin, cos, tan, asin, acos, atan, atan2, sinh,
// cosh, tanh; floor, ceil, fmod.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace irk {

template <class T, std::size_t N>
struct DualNumber;

namespace detail {

template <class T>
struct Innermost {
  using type = T;
};
template <class T, std::size_t N>
struct Innermost<DualNumber<T, N>> {
  using type = typename Innermost<T>::type;
};

/// Operands without derivatives: built-in numbers, and the innermost scalar of nested dual numbers.
template <class S, class T>
concept ConstantFor = std::is_arithmetic_v<S> || std::is_same_v<S, typename Innermost<T>::type>;

template <class S>
auto constant(const S& s) {
  if constexpr (std::is_arithmetic_v<S>) {
    return static_cast<double>(s);
  } else {
    return s;
  }
}

}  // namespace detail

template <class T, std::size_t N>
struct DualNumber {
  T value;
  std::array<T, N> d;  ///< directional derivatives

  DualNumber() : value(0), d{} {}
  DualNumber(const T& v) : value(v), d{} {}  // NOLINT: a number is a constant
  template <class S>
  requires(detail::ConstantFor<S, T> && !std::is_same_v<S, T>) DualNumber(const S& s)
      : value(detail::constant(s)), d{} {}  // NOLINT
  DualNumber(const DualNumber& b) : DualNumber(b, std::make_index_sequence<N>()) {}
  DualNumber& operator=(const DualNumber& b) {
    value = b.value;
    copyDirections(b, std::make_index_sequence<N>());
    return *this;
  }
  DualNumber(T v, T rate) requires(N == 1) : value(std::move(v)), d{std::move(rate)} {}

  /// The chain rule: f(x) for this number x, with value f and slope = f'(x).
  DualNumber chain(const T& f, const T& slope) const {
    DualNumber r(f);
    for (std::size_t i = 0; i < N; ++i) r.d[i] = slope * d[i];
    return r;
  }
  template <class S>
  DualNumber scaled(const S& s) const {
    DualNumber r(T(value * s));
    for (std::size_t i = 0; i < N; ++i) r.d[i] = d[i] * s;
    return r;
  }

  DualNumber& operator+=(const DualNumber& b) {
    value += b.value;
    for (std::size_t i = 0; i < N; ++i) d[i] += b.d[i];
    return *this;
  }
  DualNumber& operator-=(const DualNumber& b) {
    value -= b.value;
    for (std::size_t i = 0; i < N; ++i) d[i] -= b.d[i];
    return *this;
  }
  DualNumber& operator*=(const DualNumber& b) { return *this = *this * b; }
  DualNumber& operator/=(const DualNumber& b) { return *this = *this / b; }

  friend DualNumber operator+(const DualNumber& a, const DualNumber& b) {
    DualNumber r(T(a.value + b.value));
    for (std::size_t i = 0; i < N; ++i) r.d[i] = a.d[i] + b.d[i];
    return r;
  }
  friend DualNumber operator-(const DualNumber& a, const DualNumber& b) {
    DualNumber r(T(a.value - b.value));
    for (std::size_t i = 0; i < N; ++i) r.d[i] = a.d[i] - b.d[i];
    return r;
  }
  friend DualNumber operator-(const DualNumber& a) {
    DualNumber r(T(-a.value));
    for (std::size_t i = 0; i < N; ++i) r.d[i] = -a.d[i];
    return r;
  }
  friend DualNumber operator*(const DualNumber& a, const DualNumber& b) {
    DualNumber r(T(a.value * b.value));
    for (std::size_t i = 0; i < N; ++i) r.d[i] = a.d[i] * b.value + a.value * b.d[i];
    return r;
  }
  friend DualNumber operator/(const DualNumber& a, const DualNumber& b) {
    const T inverse = T(1) / b.value;
    DualNumber r(T(a.value * inverse));
    for (std::size_t i = 0; i < N; ++i) r.d[i] = (a.d[i] - r.value * b.d[i]) * inverse;
    return r;
  }

  // Operations with a constant operand skip its derivatives, which are zero. Built-in numbers and the
  // innermost scalar mix with any T.
  template <class S>
  requires detail::ConstantFor<S, T>
  friend DualNumber operator*(const S& s, const DualNumber& a) { return a.scaled(detail::constant(s)); }
  template <class S>
  requires detail::ConstantFor<S, T>
  friend DualNumber operator*(const DualNumber& a, const S& s) { return a.scaled(detail::constant(s)); }
  template <class S>
  requires detail::ConstantFor<S, T>
  friend DualNumber operator/(const DualNumber& a, const S& s) {
    return a.chain(T(a.value / detail::constant(s)), T(T(1) / detail::constant(s)));
  }
  template <class S>
  requires detail::ConstantFor<S, T>
  friend DualNumber operator+(const DualNumber& a, const S& s) {
    DualNumber r(a);
    r.value += detail::constant(s);
    return r;
  }
  template <class S>
  requires detail::ConstantFor<S, T>
  friend DualNumber operator+(const S& s, const DualNumber& a) { return a + s; }
  template <class S>
  requires detail::ConstantFor<S, T>
  friend DualNumber operator-(const DualNumber& a, const S& s) { return a + (-detail::constant(s)); }
  template <class S>
  requires detail::ConstantFor<S, T>
  friend DualNumber operator-(const S& s, const DualNumber& a) { return -a + s; }

  // Comparisons compare the values only; the derivatives are those of the branch that is taken.
  friend bool operator<(const DualNumber& a, const DualNumber& b) { return a.value < b.value; }
  friend bool operator>(const DualNumber& a, const DualNumber& b) { return b.value < a.value; }
  friend bool operator<=(const DualNumber& a, const DualNumber& b) { return a.value <= b.value; }
  friend bool operator>=(const DualNumber& a, const DualNumber& b) { return b.value <= a.value; }
  friend bool operator==(const DualNumber& a, const DualNumber& b) { return a.value == b.value; }

  friend DualNumber abs(const DualNumber& a) { return a.value < T(0) ? -a : a; }
  friend DualNumber fabs(const DualNumber& a) { return abs(a); }
  // These jump: a scene that uses them of t declares the times.
  friend DualNumber floor(const DualNumber& a) {
    using std::floor;
    return DualNumber(T(floor(a.value)));
  }
  friend DualNumber ceil(const DualNumber& a) { return -floor(-a); }
  /// The remainder of a / s with the sign of a, for a constant s.
  template <class S>
  requires detail::ConstantFor<S, T>
  friend DualNumber fmod(const DualNumber& a, const S& s) {
    using std::fmod;
    DualNumber r(a);
    r.value = T(fmod(a.value, detail::constant(s)));
    return r;
  }
  friend DualNumber sqrt(const DualNumber& a) {
    using std::sqrt;
    const T s = sqrt(a.value);
    return a.chain(s, T(T(0.5) / s));
  }
  friend DualNumber sin(const DualNumber& a) {
    using std::cos;
    using std::sin;
    return a.chain(T(sin(a.value)), T(cos(a.value)));
  }
  friend DualNumber cos(const DualNumber& a) {
    using std::cos;
    using std::sin;
    return a.chain(T(cos(a.value)), T(-sin(a.value)));
  }
  friend DualNumber exp(const DualNumber& a) {
    using std::exp;
    const T e = exp(a.value);
    return a.chain(e, e);
  }
  friend DualNumber log(const DualNumber& a) {
    using std::log;
    return a.chain(T(log(a.value)), T(T(1) / a.value));
  }
  friend DualNumber tanh(const DualNumber& a) {
    using std::tanh;
    const T y = tanh(a.value);
    return a.chain(y, T(T(1) - y * y));
  }
  friend DualNumber tan(const DualNumber& a) {
    using std::tan;
    const T y = tan(a.value);
    return a.chain(y, T(T(1) + y * y));
  }
  friend DualNumber asin(const DualNumber& a) {
    using std::asin;
    using std::sqrt;
    return a.chain(T(asin(a.value)), T(T(1) / sqrt(T(T(1) - a.value * a.value))));
  }
  friend DualNumber acos(const DualNumber& a) {
    using std::acos;
    using std::sqrt;
    return a.chain(T(acos(a.value)), T(T(-1) / sqrt(T(T(1) - a.value * a.value))));
  }
  friend DualNumber atan(const DualNumber& a) {
    using std::atan;
    return a.chain(T(atan(a.value)), T(T(1) / (T(1) + a.value * a.value)));
  }
  friend DualNumber sinh(const DualNumber& a) {
    using std::cosh;
    using std::sinh;
    return a.chain(T(sinh(a.value)), T(cosh(a.value)));
  }
  friend DualNumber cosh(const DualNumber& a) {
    using std::cosh;
    using std::sinh;
    return a.chain(T(cosh(a.value)), T(sinh(a.value)));
  }
  friend DualNumber expm1(const DualNumber& a) {
    using std::expm1;
    const T y = expm1(a.value);
    return a.chain(y, T(y + T(1)));
  }
  friend DualNumber log1p(const DualNumber& a) {
    using std::log1p;
    return a.chain(T(log1p(a.value)), T(T(1) / (T(1) + a.value)));
  }
  friend DualNumber cbrt(const DualNumber& a) {
    using std::cbrt;
    const T y = cbrt(a.value);
    return a.chain(y, T(T(1) / (T(3) * y * y)));
  }
  /// a^s for a constant s. Also for a = 0 and negative a where the power and its derivative exist (s = 2, s = 0).
  template <class S>
  requires detail::ConstantFor<S, T>
  friend DualNumber pow(const DualNumber& a, const S& s) {
    using std::pow;
    const T exponent(detail::constant(s));
    if (exponent == T(0)) return DualNumber(T(1));
    return a.chain(T(pow(a.value, exponent)), T(exponent * pow(a.value, T(exponent - T(1)))));
  }
  /// a^b for a > 0.
  friend DualNumber pow(const DualNumber& a, const DualNumber& b) { return exp(b * log(a)); }
  template <class S>
  requires detail::ConstantFor<S, T>
  friend DualNumber pow(const S& s, const DualNumber& b) { return pow(DualNumber(s), b); }
  friend DualNumber atan2(const DualNumber& y, const DualNumber& x) {
    using std::atan2;
    const T inverse = T(1) / (x.value * x.value + y.value * y.value);
    DualNumber r(T(atan2(y.value, x.value)));
    for (std::size_t i = 0; i < N; ++i) r.d[i] = (x.value * y.d[i] - y.value * x.d[i]) * inverse;
    return r;
  }
  /// Not differentiable where both are 0: NaN there.
  friend DualNumber hypot(const DualNumber& a, const DualNumber& b) {
    using std::hypot;
    const T y = hypot(a.value, b.value);
    DualNumber r(y);
    for (std::size_t i = 0; i < N; ++i) r.d[i] = (a.value * a.d[i] + b.value * b.d[i]) / y;
    return r;
  }

 private:
  // Compilers copy the whole struct by a call; its numbers then stay in memory instead of registers, which takes
  // longer.
  template <std::size_t... I>
  DualNumber(const DualNumber& from, std::index_sequence<I...>) : value(from.value), d{from.d[I]...} {}
  template <std::size_t... I>
  void copyDirections(const DualNumber& from, std::index_sequence<I...>) {
    ((d[I] = from.d[I]), ...);
  }
};

/// Number of directions per dual evaluation; a Jacobian with more columns takes several evaluations.
inline constexpr std::size_t kChunk = 8;

/// First-order dual number with kChunk directions; gives exact derivatives of a templated function.
template <class Real>
using Dual = DualNumber<Real, kChunk>;

/// A value and its time derivative.
template <class T>
using Rate = DualNumber<T, 1>;

/// The value without its derivatives, rounded to double: for branches and messages.
inline double valueOf(double x) { return x; }
template <class T>
requires(!std::is_arithmetic_v<T>) double valueOf(const T& x) { return static_cast<double>(x); }
template <class T, std::size_t N>
double valueOf(const DualNumber<T, N>& x) {
  return valueOf(x.value);
}

}  // namespace irk

namespace Eigen {
template <class T, std::size_t N>
struct NumTraits<irk::DualNumber<T, N>> : GenericNumTraits<irk::DualNumber<T, N>> {
  // NOLINTNEXTLINE(readability-identifier-naming): the names are Eigen's.
  enum { RequireInitialization = 1, ReadCost = int(N) + 1, AddCost = int(N) + 1, MulCost = 2 * int(N) + 1 };
};
}  // namespace Eigen
