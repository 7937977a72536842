#include "core/stage_solvers/block_inverses.h"

#include <algorithm>
#include <complex>
#include <iterator>

#include "core/base/small_size.h"

namespace irk {

BlockInverses::BlockInverses(const BlockForm<double>& form, std::span<const int> row_powers, Index n)
    : form_(form),
      row_powers_(row_powers),
      n_(n),
      inverses_(n <= kSmallInverse ? 4 * n * n : paddedSize(n), std::ssize(form.blocks)) {}

Outcome BlockInverses::invert(std::size_t block, const Linearization<double>& D, double h, const Vec<double>& scales) {
  return withSize<kSmallInverse>(n_, [&](auto n) {
    if constexpr (std::is_same_v<decltype(n), Index>) {
      return invertPaddedBlock(block, D, h, scales);
    } else {
      return form_.blocks[block].size == 1 ? invertSmallBlock<1>(block, D, h, scales, n)
                                           : invertSmallBlock<2>(block, D, h, scales, n);
    }
  });
}

Outcome BlockInverses::invertPaddedBlock(std::size_t block, const Linearization<double>& D, double h,
                                         const Vec<double>& scales) {
  const Index rows = paddedRows(n_);
  const std::complex<double> m1 = h * form_.blocks[block].mu;
  const std::complex<double> m2 = detail::product(m1, m1);
  const auto fill = [&](double* plane, const auto& entry) {
    for (Index j = 0; j < n_; ++j) {
      double* const column = plane + j * rows;
      for (Index i = 0; i < n_; ++i) column[i] = scales[i] * entry(j * n_ + i);
      std::fill(column + n_, column + rows, 0.0);
    }
  };
  const double *const d0 = D.d0.data(), *const d1 = D.d1.data(), *const d2 = D.d2.data();
  double* const re = inverseOf(block);
  fill(re, [=](Index k) { return d0[k] + m1.real() * d1[k] + m2.real() * d2[k]; });
  if (form_.blocks[block].size == 1) return invertPadded<1>(re, n_);
  fill(re + n_ * rows, [=](Index k) { return m1.imag() * d1[k] + m2.imag() * d2[k]; });
  return invertPadded<2>(re, n_);
}

// Computes all entries of M first and scales rows afterwards: both loops become vector instructions.
template <int Parts, class Size>
Outcome BlockInverses::invertSmallBlock(std::size_t index, const Linearization<double>& D, double h,
                                        const Vec<double>& scales, Size n) {
  const auto& block = form_.blocks[index];
  double* const inverse = inverseOf(index);
  const double *const d0 = D.d0.data(), *const d1 = D.d1.data(), *const d2 = D.d2.data();
  const std::complex<double> m1 = h * block.mu;
  const std::complex<double> m2 = detail::product(m1, m1);
  SmallMatrix split;
  double *const re = split.data(), *const im = re + n * n;
  for (Index k = 0; k < n * n; ++k) re[k] = d0[k] + m1.real() * d1[k] + m2.real() * d2[k];
  if constexpr (Parts == 2) {
    for (Index k = 0; k < n * n; ++k) im[k] = m1.imag() * d1[k] + m2.imag() * d2[k];
  }
  for (Index i = 0; i < n; ++i) {
    if (row_powers_[static_cast<std::size_t>(i)] == 0) continue;
    for (Index k = i; k < Parts * n * n; k += n) re[k] *= scales[i];
  }
  const Outcome outcome = irk::invert<Parts>(split, n);
  if constexpr (Parts == 1) {
    std::copy_n(re, n * n, inverse);
  } else {
    // With M^-1 = P + i Q the solution of M (z1 + i sigma z2) = y1 + i sigma y2 is
    // [[P, -sigma Q], [Q / sigma, P]] (y1, y2).
    const double divided = 1 / block.sigma;
    for (Index j = 0; j < n; ++j) {
      const double *const P = split.data() + j * n, *const Q = P + n * n;
      double *const left = inverse + j * 2 * n, *const right = left + 2 * n * n;
      for (Index i = 0; i < n; ++i) {
        left[i] = right[n + i] = P[i];
        left[n + i] = divided * Q[i];
        right[i] = -block.sigma * Q[i];
      }
    }
  }
  return outcome;
}

}  // namespace irk
