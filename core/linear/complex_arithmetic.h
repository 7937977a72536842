// Arithmetic of real and complex numbers for eliminations: without the standard's treatment of infinities.
#pragma once

#include <cmath>
#include <complex>
#include <type_traits>

#include "irk/scalar.h"

namespace irk::detail {

template <class Real>
Real magnitude(const Real& x) {
  using std::abs;
  return abs(x);
}
template <class Real>
Real magnitude(const std::complex<Real>& x) {
  using std::abs;
  return abs(x.real()) + abs(x.imag());
}

template <class Real>
Real product(const Real& a, const Real& b) {
  return a * b;
}
/// The product without the standard's treatment of infinities, which costs more than the product itself.
template <class Real>
std::complex<Real> product(const std::complex<Real>& a, const std::complex<Real>& b) {
  return {a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real()};
}

template <class Real>
Real inverse(const Real& x) {
  return Real(1) / x;
}
/// Smith's division: it overflows only if the result does.
template <class Real>
std::complex<Real> inverse(const std::complex<Real>& x) {
  using std::abs;
  const Real &a = x.real(), &b = x.imag();
  if (abs(a) >= abs(b)) {
    const Real ratio = b / a, scale = Real(1) / (a + b * ratio);
    return {scale, -ratio * scale};
  }
  const Real ratio = a / b, scale = Real(1) / (a * ratio + b);
  return {ratio * scale, -scale};
}

/// y -= f x
template <class Real>
void subtract(Real* y, const Real* x, const Real& f, Index n) {
  for (Index i = 0; i < n; ++i) y[i] -= f * x[i];
}
template <class Real>
void subtract(std::complex<Real>* y, const std::complex<Real>* x, const std::complex<Real>& f, Index n) {
  if constexpr (std::is_floating_point_v<Real>) {  // complex arrays are arrays of pairs, [complex.numbers]
    const Real fr = f.real(), fi = f.imag();
    Real* const Y = reinterpret_cast<Real*>(y);
    const Real* const X = reinterpret_cast<const Real*>(x);
    for (Index i = 0; i < 2 * n; i += 2) {
      Y[i] -= fr * X[i] - fi * X[i + 1];
      Y[i + 1] -= fr * X[i + 1] + fi * X[i];
    }
  } else {
    for (Index i = 0; i < n; ++i) y[i] -= product(f, x[i]);
  }
}

}  // namespace irk::detail
