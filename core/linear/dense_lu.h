// Dense LU with partial pivoting. It allocates in its constructor only and reports a zero pivot.
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/small_size.h"
#include "irk/outcome.h"

namespace irk {
namespace detail {

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

}  // namespace detail

/// LU of an n x n matrix; T is real or complex, n is fixed by the constructor. Up to `kPlainLu` unknowns it uses
/// plain loops by columns, above that Eigen's blocked LU. Measured for complex doubles, the plain loops factorize
/// in a fifth (n = 2) to three quarters (n = 200) of Eigen's time, and faster than LAPACK's zgetrf (OpenBLAS) up
/// to n = 48.
template <class T>
class DenseLu {
 public:
  explicit DenseLu(Index n) : matrix_(n, n), pivots_(static_cast<std::size_t>(n)), lu_(plain() ? 0 : n) {}

  /// Fill all entries (by columns) before `factorize`, which may overwrite them.
  Mat<T>& matrix() { return matrix_; }
  T* values() { return matrix_.data(); }

  /// Returns kSuccess, kSingular or kNotFinite. After a failure `solve` must not be called.
  [[nodiscard]] Outcome factorize() {
    if (plain()) {
      return withSize<kUnrolled>(matrix_.rows(), [this](auto n) { return factorizePlain(n); });
    }
    if (!matrix_.allFinite()) return Outcome::kNotFinite;
    lu_.compute(matrix_);
    for (Index i = 0; i < matrix_.rows(); ++i) {
      if (lu_.matrixLU()(i, i) == T(0)) return Outcome::kSingular;
    }
    return Outcome::kSuccess;
  }

  /// Solves in place; x has n contiguous entries.
  void solve(T* x) {
    if (plain()) {
      return withSize<kUnrolled>(matrix_.rows(), [this, x](auto n) { solvePlain(x, n); });
    }
    VecView<T> view(x, matrix_.rows());
    matrix_.col(0) = view;  // scratch
    view.noalias() = lu_.permutationP() * matrix_.col(0);
    lu_.matrixLU().template triangularView<Eigen::UnitLower>().solveInPlace(view);
    lu_.matrixLU().template triangularView<Eigen::Upper>().solveInPlace(view);
  }

 private:
  static constexpr Index kPlainLu = 128;
  static constexpr Index kUnrolled = std::is_floating_point_v<decltype(detail::magnitude(T()))> ? 4 : 0;

  bool plain() const { return matrix_.rows() <= kPlainLu; }

  // The diagonal holds the inverse pivots. A number that is not finite above the diagonal spreads below it during
  // elimination, where the search for the pivot finds it.
  template <class Size>
  Outcome factorizePlain(Size n) {
    using std::isfinite;
    T* const a = matrix_.data();
    for (Index k = 0; k < n; ++k) {
      T* const column = a + k * n;
      Index pivot = k;
      auto largest = detail::magnitude(column[k]);
      auto sum = largest;
      for (Index i = k + 1; i < n; ++i) {
        const auto size = detail::magnitude(column[i]);
        sum += size;
        if (size > largest) largest = size, pivot = i;
      }
      if (!isfinite(sum)) return Outcome::kNotFinite;
      if (largest == 0) return Outcome::kSingular;
      pivots_[static_cast<std::size_t>(k)] = pivot;
      if (pivot != k) {
        for (Index j = 0; j < n; ++j) std::swap(a[j * n + k], a[j * n + pivot]);
      }
      column[k] = detail::inverse(column[k]);
      for (Index i = k + 1; i < n; ++i) column[i] = detail::product(column[i], column[k]);
      for (Index j = k + 1; j < n; ++j) {
        detail::subtract(a + j * n + k + 1, column + k + 1, a[j * n + k], n - k - 1);
      }
    }
    return Outcome::kSuccess;
  }

  template <class Size>
  void solvePlain(T* x, Size n) const {
    const T* const a = matrix_.data();
    for (Index k = 0; k < n; ++k) {
      const Index pivot = pivots_[static_cast<std::size_t>(k)];
      if (pivot != k) std::swap(x[k], x[pivot]);
    }
    for (Index k = 0; k < n; ++k) detail::subtract(x + k + 1, a + k * n + k + 1, x[k], n - k - 1);
    for (Index k = n; k-- > 0;) {
      x[k] = detail::product(x[k], a[k * n + k]);
      detail::subtract(x, a + k * n, x[k], k);
    }
  }

  Mat<T> matrix_;
  std::vector<Index> pivots_;
  Eigen::PartialPivLU<Mat<T>> lu_;
};

}  // namespace irk
