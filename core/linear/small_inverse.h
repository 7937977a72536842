// Inverses of matrices with a few rows. A product with the inverse is faster than substitution with factors, where
// each row waits for the one before.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <utility>

#include "core/linear/dense_lu.h"

namespace irk {

/// Blocks of the Newton matrix with up to this many unknowns are inverted. Measured for complex n = 8: the inverse
/// takes as long as the factors (its loops become vector instructions), a product a sixth of the time of the
/// substitutions.
inline constexpr Index kSmallInverse = 8;

/// A view of a real (Parts = 1) or complex (Parts = 2) n x n matrix, by columns; all real parts come before all
/// imaginary parts, so that loops over rows become vector instructions.
template <class Real, int Parts>
class SplitMatrix {
 public:
  using Value = std::conditional_t<Parts == 1, Real, std::complex<Real>>;

  SplitMatrix(Real* data, Index n) : data_(data), imaginary_(n * n) {}
  Value get(Index at) const {
    if constexpr (Parts == 1) {
      return data_[at];
    } else {
      return {data_[at], data_[imaginary_ + at]};
    }
  }
  void set(Index at, const Value& x) {
    if constexpr (Parts == 1) {
      data_[at] = x;
    } else {
      data_[at] = x.real();
      data_[imaginary_ + at] = x.imag();
    }
  }
  void swap(Index a, Index b) {
    std::swap(data_[a], data_[b]);
    if constexpr (Parts == 2) std::swap(data_[imaginary_ + a], data_[imaginary_ + b]);
  }
  /// A copy of one column, so that the numbers read and the numbers written cannot overlap.
  struct Column {
    alignas(64) std::array<Real, static_cast<std::size_t>(kSmallInverse)> re, im;
  };
  template <class Size>
  void copy(Index from, Size n, Column& x) const {
    std::copy_n(data_ + from, n, x.re.data());
    if constexpr (Parts == 2) std::copy_n(data_ + imaginary_ + from, n, x.im.data());
  }
  /// n entries from `y` on -= f x.
  template <class Size>
  void subtract(Index y, const Column& x, const Value& f, Size n) {
    Real* const re = data_ + y;
    const Real* const from_re = x.re.data();
    if constexpr (Parts == 1) {
      for (Index i = 0; i < n; ++i) re[i] -= f * from_re[i];
    } else {
      Real* const im = re + imaginary_;
      const Real* const from_im = x.im.data();
      const Real fr = f.real(), fi = f.imag();
      for (Index i = 0; i < n; ++i) re[i] -= fr * from_re[i] - fi * from_im[i];
      for (Index i = 0; i < n; ++i) im[i] -= fr * from_im[i] + fi * from_re[i];
    }
  }

 private:
  Real* data_;
  Index imaginary_;
};

/// Replaces the n x n matrix at `data` (n <= kSmallInverse) by its inverse: Gauss-Jordan with partial pivoting.
/// Returns kSuccess, kSingular or kNotFinite; after a failure the entries are unspecified.
template <int Parts, class Real, class Size>
[[nodiscard]] Outcome invert(Real* data, Size n) {
  using std::isfinite;
  SplitMatrix<Real, Parts> a(data, n);
  using Value = typename SplitMatrix<Real, Parts>::Value;
  typename SplitMatrix<Real, Parts>::Column rest;
  std::array<Index, static_cast<std::size_t>(kSmallInverse)> pivots;
  for (Index k = 0; k < n; ++k) {
    const Index column = k * n;
    Index pivot = k;
    Real largest(0), sum(0);
    for (Index i = 0; i < n; ++i) {
      const Real size = detail::magnitude(a.get(column + i));
      sum += size;
      if (i >= k && size > largest) largest = size, pivot = i;
    }
    if (!isfinite(sum)) return Outcome::kNotFinite;
    if (largest == Real(0)) return Outcome::kSingular;
    pivots[static_cast<std::size_t>(k)] = pivot;
    for (Index j = 0; j < n && pivot != k; ++j) a.swap(j * n + k, j * n + pivot);
    const Value inverse = detail::inverse(a.get(column + k));
    a.set(column + k, Value(0));
    a.copy(column, n, rest);
    for (Index j = 0; j < n; ++j) {
      if (j == k) continue;
      const Value f = detail::product(a.get(j * n + k), inverse);
      a.subtract(j * n, rest, f, n);  // rest[k] = 0
      a.set(j * n + k, f);            // set last: the vector operation does not wait for this number
    }
    for (Index i = 0; i < n; ++i) a.set(column + i, detail::product(-a.get(column + i), inverse));
    a.set(column + k, inverse);
  }
  for (Index k = n; k-- > 0;) {
    const Index pivot = pivots[static_cast<std::size_t>(k)];
    for (Index i = 0; i < n && pivot != k; ++i) a.swap(k * n + i, pivot * n + i);
  }
  return Outcome::kSuccess;
}

/// y := A y, A m x m by columns, m <= 2 kSmallInverse.
template <class Real, class Size>
[[gnu::always_inline]] inline void multiplySmall(const Real* A, Real* y, Size m) {
  constexpr auto kMax = static_cast<std::size_t>(2 * kSmallInverse);
  std::array<Real, kMax> even, odd;  // two independent sums: neither waits for the other
  for (Index i = 0; i < m; ++i) even[static_cast<std::size_t>(i)] = A[i] * y[0];
  for (Index i = 0; i < m; ++i) odd[static_cast<std::size_t>(i)] = Real(0);
  for (Index j = 1; j + 1 < m; j += 2) {
    for (Index i = 0; i < m; ++i) odd[static_cast<std::size_t>(i)] += A[j * m + i] * y[j];
    for (Index i = 0; i < m; ++i) {
      even[static_cast<std::size_t>(i)] += A[(j + 1) * m + i] * y[j + 1];
    }
  }
  if (m % 2 == 0) {
    for (Index i = 0; i < m; ++i) {
      odd[static_cast<std::size_t>(i)] += A[(m - 1) * m + i] * y[m - 1];
    }
  }
  for (Index i = 0; i < m; ++i) {
    y[i] = even[static_cast<std::size_t>(i)] + odd[static_cast<std::size_t>(i)];
  }
}

}  // namespace irk
