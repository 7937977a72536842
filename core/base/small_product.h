// Products of matrices with few rows. There a general product spends more time on overhead than on arithmetic.
#pragma once

#include <array>
#include <cstring>
#include <type_traits>

#include "core/base/small_size.h"
#include "core/base/threads.h"
#include "irk/scalar.h"

namespace irk {
namespace detail {

/// Eight numbers in a vector register. A struct, because compilers warn of functions that return bare vectors.
struct Eight {
  double __attribute__((vector_size(8 * sizeof(double)))) v{};

  friend Eight operator+(const Eight& a, const Eight& b) { return {a.v + b.v}; }
  friend Eight operator*(double a, const Eight& b) { return {a * b.v}; }
};

/// y_0 to y_7.
inline Eight eightFrom(const double* y) {
  Eight all;
  std::memcpy(&all.v, y, sizeof all.v);
  return all;
}

}  // namespace detail

// What the sums of a product begin with: `(i, j)` for one of them, `eight(i, j)` for those of the rows i to i + 7;
// `from(i)` is the same for a product whose first row is i.

/// The sums begin with 0.
template <class Real>
struct FromZero {
  Real operator()(Index, Index) const { return Real(0); }
  detail::Eight eight(Index, Index) const { return {}; }
  FromZero from(Index) const { return {}; }
};
/// The sums begin with y_i in each column.
template <class Real>
struct FromColumn {
  const Real* y;
  Real operator()(Index i, Index) const { return y[i]; }
  detail::Eight eight(Index i, Index) const { return detail::eightFrom(y + i); }
  FromColumn from(Index i) const { return {y + i}; }
};
/// The sums begin with y_i + factor_j slope_i.
template <class Real>
struct FromLine {
  const Real *y, *slope, *factors;
  Real operator()(Index i, Index j) const { return y[i] + factors[j] * slope[i]; }
  detail::Eight eight(Index i, Index j) const {
    return detail::eightFrom(y + i) + factors[j] * detail::eightFrom(slope + i);
  }
  FromLine from(Index i) const { return {y + i, slope + i, factors}; }
};

namespace detail {

/// Square matrices of this size at most are unrolled by columns, too.
inline constexpr Index kUnrolledColumns = 3;
/// Up to so many rows products of that size are made without a call.
inline constexpr Index kInlinedRows = 4;

/// All of N x K times K x C. Reads everything before it writes: else the compiler asks at run time whether `out`
/// overlaps what is read, which takes longer than the product.
template <Index N, Index K, Index C, class Real, class Start>
[[gnu::always_inline]] inline void unrolledProduct(const Real* A, Index stride, const Real* B, Real* out,
                                                   Index out_stride, Index row, const Start& start) {
  std::array<Real, static_cast<std::size_t>(N * K)> a;
  std::array<Real, static_cast<std::size_t>(N * C)> sum;
  for (Index k = 0; k < K; ++k) {
    for (Index i = 0; i < N; ++i) a[static_cast<std::size_t>(k * N + i)] = A[k * stride + i];
  }
  for (Index j = 0; j < C; ++j) {
    Real* const s = sum.data() + j * N;
    for (Index i = 0; i < N; ++i) s[i] = start(row + i, j);
    for (Index k = 0; k < K; ++k) {
      for (Index i = 0; i < N; ++i) s[i] += a[static_cast<std::size_t>(k * N + i)] * B[j * K + k];
    }
  }
  for (Index j = 0; j < C; ++j) {
    for (Index i = 0; i < N; ++i) out[j * out_stride + i] = sum[static_cast<std::size_t>(j * N + i)];
  }
}

/// Computes N rows, out(:, j) = start(j) + sum_k A(:, k) B(k, j), with N accumulators in registers.
template <Index N, class Real, class RightHand, class Start>
[[gnu::always_inline]] inline void productRows(const Real* A, Index stride, const RightHand& B, Real* out,
                                               Index out_stride, Index row, const Start& start) {
  // Small products are unrolled: the control of their loops would cost more than their arithmetic.
  constexpr Index kMaxInner = N <= 3 ? unrolledSizes<Real>(9) : 0;
  const auto columns = [&](auto inner, auto count) {
    for (Index j = 0; j < count; ++j) {
      Real sum[static_cast<std::size_t>(N)];
      for (Index i = 0; i < N; ++i) sum[i] = start(row + i, j);
      const Real* const b = B.data() + j * inner;
      for (Index k = 0; k < inner; ++k) {
        for (Index i = 0; i < N; ++i) sum[i] += A[k * stride + i] * b[k];
      }
      for (Index i = 0; i < N; ++i) out[j * out_stride + i] = sum[i];
    }
  };
  withSize<kMaxInner>(B.rows(), [&](auto inner) {
    if constexpr (!std::is_same_v<decltype(inner), Index>) {
      if constexpr (decltype(inner)::value <= kUnrolledColumns) {
        constexpr Index kInner = decltype(inner)::value;
        if (B.cols() == inner) {
          return unrolledProduct<N, kInner, kInner>(A, stride, B.data(), out, out_stride, row, start);
        }
      }
    }
    columns(inner, B.cols());
  });
}

/// The same for eight rows. Their sums are vectors, whatever vectors the compiler chooses for loops.
template <class RightHand, class Start>
[[gnu::always_inline]] inline void productOfEightRows(const double* A, Index stride, const RightHand& B, double* out,
                                                      Index out_stride, Index row, const Start& start) {
  for (Index j = 0; j < B.cols(); ++j) {
    Eight sum = start.eight(row, j);
    const double* const b = B.data() + j * B.rows();
    for (Index k = 0; k < B.rows(); ++k) sum = sum + b[k] * eightFrom(A + k * stride);
    std::memcpy(out + j * out_stride, &sum.v, sizeof sum.v);
  }
}

}  // namespace detail

/// out(i, j) = start(i, j) + sum_k A(i, k) B(k, j) for i < rows. The columns of A and out are `stride` and
/// `out_stride` numbers apart; A and out must not overlap. B is a matrix or vector without gaps. Start is one of the
/// three above. The product is computed by blocks of rows whose sums stay in registers. For two rows it takes a tenth
/// of the time of a general product, and for hundreds of rows not more than that product, since B is small.
template <class Real, class RightHand, class Start>
void smallProduct(const Real* A, Index stride, Index rows, const RightHand& B, Real* out, Index out_stride,
                  const Start& start) {
  constexpr Index kBlock = 8;
  if constexpr (!std::is_same_v<Real, double>) {
    for (Index i = 0; i < rows; ++i) detail::productRows<1>(A + i, stride, B, out + i, out_stride, i, start);
  } else {
    Index i = 0;
    for (; i + kBlock <= rows; i += kBlock) {
      detail::productOfEightRows(A + i, stride, B, out + i, out_stride, i, start);
    }
    for (; i + 4 <= rows; i += 4) {
      detail::productRows<4>(A + i, stride, B, out + i, out_stride, i, start);
    }
    switch (rows - i) {
      case 3:
        return detail::productRows<3>(A + i, stride, B, out + i, out_stride, i, start);
      case 2:
        return detail::productRows<2>(A + i, stride, B, out + i, out_stride, i, start);
      case 1:
        return detail::productRows<1>(A + i, stride, B, out + i, out_stride, i, start);
      default:
        return;
    }
  }
}

/// The same with start = 0.
template <class Real, class RightHand>
void smallProduct(const Real* A, Index stride, Index rows, const RightHand& B, Real* out, Index out_stride) {
  smallProduct(A, stride, rows, B, out, out_stride, FromZero<Real>());
}

/// out = A B for matrices or vectors; B has no gaps. `out` has the right size and does not overlap A or B.
template <class Real, class RightHand, class Result>
void smallProduct(const Eigen::Ref<const Mat<Real>>& A, const RightHand& B, Result&& out) {
  smallProduct(A.data(), A.outerStride(), A.rows(), B, out.data(), out.outerStride());
}

/// The same as smallProduct, for places where its call takes longer than its arithmetic: with up to four rows and a
/// square B of up to three, or one such column, the product is made in place.
template <class Real, class RightHand, class Start>
[[gnu::always_inline]] inline void inlinedProduct(const Real* A, Index stride, Index rows, const RightHand& B,
                                                  Real* out, Index out_stride, const Start& start) {
  constexpr bool kColumn = RightHand::ColsAtCompileTime == 1;
  const bool few = rows <= detail::kInlinedRows && B.rows() <= detail::kUnrolledColumns;
  if constexpr (std::is_same_v<Real, double>) {
    if (few && (kColumn || B.cols() == B.rows())) {
      return withSize<detail::kInlinedRows>(rows, [&](auto n) {
        using Rows = decltype(n);
        if constexpr (!std::is_same_v<Rows, Index>) {  // else there are no rows
          withSize<detail::kUnrolledColumns>(B.rows(), [&](auto k) {
            using Inner = decltype(k);
            if constexpr (!std::is_same_v<Inner, Index>) {
              constexpr Index C = kColumn ? 1 : Inner::value;
              detail::unrolledProduct<Rows::value, Inner::value, C>(A, stride, B.data(), out, out_stride, 0, start);
            }
          });
        }
      });
    }
  }
  smallProduct(A, stride, rows, B, out, out_stride, start);
}

/// The same with start = 0.
template <class Real, class RightHand>
[[gnu::always_inline]] inline void inlinedProduct(const Real* A, Index stride, Index rows, const RightHand& B,
                                                  Real* out, Index out_stride) {
  inlinedProduct(A, stride, rows, B, out, out_stride, FromZero<Real>());
}

/// The same on up to `threads` threads, each with its part of the rows.
template <class Real, class RightHand, class Start>
[[gnu::always_inline]] inline void productOnThreads(int threads, const Real* A, Index stride, Index rows,
                                                    const RightHand& B, Real* out, Index out_stride,
                                                    const Start& start) {
  if (threads <= 1) return inlinedProduct(A, stride, rows, B, out, out_stride, start);
  inParts(threads, rows, [&](Index first, Index last) {
    smallProduct(A + first, stride, last - first, B, out + first, out_stride, start.from(first));
  });
}

/// The same with start = 0.
template <class Real, class RightHand>
[[gnu::always_inline]] inline void productOnThreads(int threads, const Real* A, Index stride, Index rows,
                                                    const RightHand& B, Real* out, Index out_stride) {
  productOnThreads(threads, A, stride, rows, B, out, out_stride, FromZero<Real>());
}

}  // namespace irk
