// Dense LU with partial pivoting. It allocates in its constructor only and reports a zero pivot.
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/small_size.h"
#include "core/linear/complex_arithmetic.h"
#include "core/linear/split_lu.h"
#include "irk/outcome.h"

namespace irk {

/// LU of an n x n matrix; T is real or complex, n is fixed by the constructor. Up to `kPlainLu` unknowns it uses
/// plain loops by columns, above that SplitLu for complex doubles and Eigen's blocked LU for other numbers. Measured
/// for complex doubles on a processor with AVX-512: the plain loops are as fast as SplitLu at n = 20 and five times as
/// fast as Eigen at n = 2; SplitLu takes 0.4 of their time at n = 100, and 0.6 of Eigen's at n = 200.
template <class T>
class DenseLu {
  static constexpr bool kSplit = std::is_same_v<T, std::complex<double>>;

 public:
  explicit DenseLu(Index n) : n_(n), pivots_(static_cast<std::size_t>(n)), lu_(plain() ? 0 : n) {
    if (!kSplit || plain()) matrix_.resize(n, n);
  }

  /// Fill all entries before `factorize`, which may overwrite them: entry(i) is that in row i of column j.
  template <class Entry>
  void fillColumn(Index j, const Entry& entry) {
    if constexpr (kSplit) {
      if (!plain()) {
        double *const re = lu_.re(j), *const im = lu_.im(j);
        for (Index i = 0; i < n_; ++i) {
          const T x = entry(i);
          re[i] = x.real();
          im[i] = x.imag();
        }
        return;
      }
    }
    T* const column = matrix_.data() + j * n_;
    for (Index i = 0; i < n_; ++i) column[i] = entry(i);
  }
  /// The same, by columns.
  Mat<T>& matrix() requires(!kSplit) { return matrix_; }
  T* values() requires(!kSplit) { return matrix_.data(); }

  /// Returns kSuccess, kSingular or kNotFinite. After a failure `solve` must not be called.
  [[nodiscard]] Outcome factorize() {
    if (plain()) {
      return withSize<kUnrolled>(n_, [&](auto n) { return factorizePlain(n); });
    }
    if constexpr (kSplit) {
      return lu_.factorize();
    } else {
      if (!matrix_.allFinite()) return Outcome::kNotFinite;
      lu_.compute(matrix_);
      for (Index i = 0; i < n_; ++i) {
        if (lu_.matrixLU()(i, i) == T(0)) return Outcome::kSingular;
      }
      return Outcome::kSuccess;
    }
  }

  /// Solves in place; x has n contiguous entries.
  void solve(T* x) {
    if (plain()) {
      return withSize<kUnrolled>(n_, [&](auto n) { solvePlain(x, n); });
    }
    if constexpr (kSplit) {
      lu_.solve(x);
    } else {
      VecView<T> view(x, n_);
      matrix_.col(0) = view;  // scratch
      view.noalias() = lu_.permutationP() * matrix_.col(0);
      lu_.matrixLU().template triangularView<Eigen::UnitLower>().solveInPlace(view);
      lu_.matrixLU().template triangularView<Eigen::Upper>().solveInPlace(view);
    }
  }

 private:
  static constexpr Index kPlainLu = kSplit ? 28 : 128;
  static constexpr Index kUnrolled = std::is_floating_point_v<decltype(detail::magnitude(T()))> ? 4 : 0;

  bool plain() const { return n_ <= kPlainLu; }

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

  Index n_;
  Mat<T> matrix_;  // empty where lu_ has one of its own
  std::vector<Index> pivots_;
  std::conditional_t<kSplit, SplitLu, Eigen::PartialPivLU<Mat<T>>> lu_;
};

}  // namespace irk
