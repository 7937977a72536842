#include "core/linear/split_lu.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/linear/complex_arithmetic.h"

namespace irk {
namespace {

using Complex = std::complex<double>;

// Rows and columns are taken in groups of 8, the columns of a panel; 8 rows fill a line of the cache.
constexpr Index kGroup = 8;
// One vector register, and the block of sums of a product: as many of them as there are registers for.
constexpr Index kLanes = std::min<Index>(Eigen::internal::packet_traits<double>::size, kGroup);
constexpr std::size_t kTileRows = 2, kTileColumns = kLanes == 8 ? 4 : 2;
using Lanes = Eigen::Array<double, static_cast<int>(kLanes), 1>;
using In = Eigen::Map<const Lanes, Eigen::AlignedMax>;
using Out = Eigen::Map<Lanes, Eigen::AlignedMax>;

/// A part of a matrix by columns. Imaginary parts are `plane` numbers behind the real ones.
struct Planes {
  double* re;
  Index stride, plane;

  Planes from(Index row, Index column) const { return {re + row + column * stride, stride, plane}; }
  Complex get(Index row, Index column) const {
    const double* const x = re + row + column * stride;
    return {x[0], x[plane]};
  }
  void set(Index row, Index column, const Complex& x) const {
    double* const to = re + row + column * stride;
    to[0] = x.real();
    to[plane] = x.imag();
  }
  // x(row, column) -= a b
  void subtract(Index row, Index column, const Complex& a, const Complex& b) const {
    set(row, column, get(row, column) - detail::product(a, b));
  }
};

// C -= A B for kLanes * Rows rows and Columns columns of C, which is read and written once. The order of the updates
// keeps those of one sum apart from each other.
template <std::size_t Rows, std::size_t Columns>
[[gnu::always_inline]] inline void tile(const Planes& A, const Planes& B, const Planes& C, Index inner) {
  const auto lanes = [](std::size_t i) { return static_cast<Index>(i) * kLanes; };
  const auto column = [&C](std::size_t j) { return C.re + static_cast<Index>(j) * C.stride; };
  Lanes re[Columns][Rows], im[Columns][Rows];
  for (std::size_t j = 0; j < Columns; ++j) {
    for (std::size_t i = 0; i < Rows; ++i) {
      re[j][i] = In(column(j) + lanes(i));
      im[j][i] = In(column(j) + C.plane + lanes(i));
    }
  }
  const double* a = A.re;
  for (Index k = 0; k < inner; ++k, a += A.stride) {
    Lanes a_re[Rows], a_im[Rows];
    for (std::size_t i = 0; i < Rows; ++i) {
      a_re[i] = In(a + lanes(i));
      a_im[i] = In(a + A.plane + lanes(i));
    }
    for (std::size_t j = 0; j < Columns; ++j) {
      const double* const b = B.re + k + static_cast<Index>(j) * B.stride;
      const double b_re = b[0], b_im = b[B.plane];
      for (std::size_t i = 0; i < Rows; ++i) re[j][i] -= a_re[i] * b_re;
      for (std::size_t i = 0; i < Rows; ++i) im[j][i] -= a_im[i] * b_re;
      for (std::size_t i = 0; i < Rows; ++i) re[j][i] += a_im[i] * b_im;
      for (std::size_t i = 0; i < Rows; ++i) im[j][i] -= a_re[i] * b_im;
    }
  }
  for (std::size_t j = 0; j < Columns; ++j) {
    for (std::size_t i = 0; i < Rows; ++i) {
      Out(column(j) + lanes(i)) = re[j][i];
      Out(column(j) + C.plane + lanes(i)) = im[j][i];
    }
  }
}

template <std::size_t Rows>
void tiles(const Planes& A, const Planes& B, const Planes& C, Index columns, Index inner) {
  constexpr Index kColumns = kTileColumns;
  Index j = 0;
  for (; j + kColumns <= columns; j += kColumns) tile<Rows, kTileColumns>(A, B.from(0, j), C.from(0, j), inner);
  for (; j < columns; ++j) tile<Rows, 1>(A, B.from(0, j), C.from(0, j), inner);
}

// C -= A B; `rows` is a multiple of kGroup, and the first of them are at the beginning of a line of the cache.
void subtractProduct(const Planes& A, const Planes& B, const Planes& C, Index rows, Index columns, Index inner) {
  constexpr Index kTile = static_cast<Index>(kTileRows) * kLanes;
  Index i = 0;
  for (; i + kTile <= rows; i += kTile) tiles<kTileRows>(A.from(i, 0), B, C.from(i, 0), columns, inner);
  for (; i < rows; i += kLanes) tiles<1>(A.from(i, 0), B, C.from(i, 0), columns, inner);
}

// The first `rows` <= kGroup rows of B become L^-1 B, L unit lower triangular. Rows behind them, up to kGroup, change.
void solveSmallLower(const Planes& L, const Planes& B, Index rows, Index columns) {
  using Group = Eigen::Array<double, static_cast<int>(kGroup), 1>;
  constexpr auto kCount = static_cast<std::size_t>(kGroup);
  std::array<Group, kCount> re, im;  // the columns of L below the diagonal
  for (Index k = 0; k + 1 < rows; ++k) {
    const double* const column = L.re + k * L.stride;
    for (Index i = 0; i < kGroup; ++i) {
      re[static_cast<std::size_t>(k)][i] = i > k ? column[i] : 0;
      im[static_cast<std::size_t>(k)][i] = i > k ? column[i + L.plane] : 0;
    }
  }
  for (Index j = 0; j < columns; ++j) {
    double* const to = B.re + j * B.stride;
    Group b_re = Eigen::Map<const Group>(to), b_im = Eigen::Map<const Group>(to + B.plane);
    for (Index k = 0; k + 1 < rows; ++k) {
      const double x = b_re[k], y = b_im[k];
      const auto c = static_cast<std::size_t>(k);
      b_re -= re[c] * x - im[c] * y;
      b_im -= re[c] * y + im[c] * x;
    }
    Eigen::Map<Group>{to} = b_re;
    Eigen::Map<Group>(to + B.plane) = b_im;
  }
}

// B := L^-1 B, L unit lower triangular; `size` is a multiple of kGroup.
void solveLower(const Planes& L, const Planes& B, Index size, Index columns) {
  if (size == kGroup) return solveSmallLower(L, B, size, columns);
  const Index half = (size / 2 + kGroup - 1) / kGroup * kGroup;
  solveLower(L, B, half, columns);
  subtractProduct(L.from(half, 0), B, B.from(half, 0), size - half, columns, half);
  solveLower(L.from(half, half), B.from(half, 0), size - half, columns);
}

struct Largest {
  Index row;
  double size, sum;
};

// The row of the largest magnitude, |re| + |im|, among `rows` rows from `first` on.
Largest largest(const Planes& column, Index first, Index rows) {
  Largest found{first, 0, 0};
  for (Index i = first; i < rows; ++i) {
    const double size = std::abs(column.re[i]) + std::abs(column.re[i + column.plane]);
    found.sum += size;
    if (size > found.size) found.size = size, found.row = i;
  }
  return found;
}

}  // namespace

SplitLu::SplitLu(Index n) : n_(n), pivots_(static_cast<std::size_t>(n)) {
  // An odd number of groups: columns that begin at multiples of a page would share few lines of the cache.
  const Index groups = (n + kGroup - 1) / kGroup;
  stride_ = kGroup * (groups + (groups % 2 == 0 ? 1 : 0));
  rows_ = kGroup * groups;
  plane_ = stride_ * n;
  data_.setZero(2 * plane_);
  x_.setZero(2 * stride_);
}

Outcome SplitLu::factorize() { return factorize(0, n_); }

// Columns first, ..., first + count - 1, in the rows from `first` on.
Outcome SplitLu::factorize(Index first, Index count) {
  if (count <= kGroup) return factorizePanel(first, count);
  const Index half = (count / 2 + kGroup - 1) / kGroup * kGroup, second = first + half, rest = count - half;
  const Planes A{data_.data(), stride_, plane_};
  Outcome outcome = factorize(first, half);
  if (outcome != Outcome::kSuccess) return outcome;
  exchangeRows(first, half, second, rest);
  solveLower(A.from(first, first), A.from(first, second), half, rest);
  subtractProduct(A.from(second, first), A.from(first, second), A.from(second, second), rows_ - second, rest, half);
  outcome = factorize(second, rest);
  if (outcome == Outcome::kSuccess) exchangeRows(second, rest, first, half);
  return outcome;
}

// At most kGroup columns, from left to right: each is brought up to date by those before it, then divided by its pivot.
// The diagonal holds the inverse pivots. A number that is not finite above the diagonal spreads below it, where the
// search for the pivot finds it.
Outcome SplitLu::factorizePanel(Index first, Index count) {
  const Planes A = Planes{data_.data(), stride_, plane_}.from(first, first);
  const Index rows = n_ - first, below = std::min(kGroup, rows);
  for (Index j = 0; j < count; ++j) {
    const Planes column = A.from(0, j);
    for (Index k = 0; k < j; ++k) {
      const Complex f = column.get(k, 0);
      for (Index i = k + 1; i < below; ++i) column.subtract(i, 0, A.get(i, k), f);
    }
    subtractProduct(A.from(kGroup, 0), column, column.from(kGroup, 0), rows_ - first - kGroup, 1, j);
    const Largest pivot = largest(column, j, rows);
    if (!std::isfinite(pivot.sum)) return Outcome::kNotFinite;
    if (pivot.size == 0) return Outcome::kSingular;
    pivots_[static_cast<std::size_t>(first + j)] = first + pivot.row;
    exchangeRows(first + j, 1, first, count);
    const Complex inverse = detail::inverse(column.get(j, 0));
    for (Index i = j + 1; i < rows; ++i) column.set(i, 0, detail::product(column.get(i, 0), inverse));
    column.set(j, 0, inverse);
  }
  return Outcome::kSuccess;
}

void SplitLu::exchangeRows(Index first_pivot, Index pivots, Index first, Index count) {
  for (Index j = first; j < first + count; ++j) {
    for (double* const x : {re(j), im(j)}) {
      for (Index k = first_pivot; k < first_pivot + pivots; ++k) {
        std::swap(x[k], x[pivots_[static_cast<std::size_t>(k)]]);
      }
    }
  }
}

void SplitLu::solve(Complex* b) {
  const Planes A{data_.data(), stride_, plane_}, x{x_.data(), stride_, stride_};
  for (Index i = 0; i < n_; ++i) x.set(i, 0, b[i]);
  for (Index k = 0; k < n_; ++k) {
    const Index pivot = pivots_[static_cast<std::size_t>(k)];
    std::swap(x_[k], x_[pivot]);
    std::swap(x_[stride_ + k], x_[stride_ + pivot]);
  }
  for (Index k = 0; k < n_; k += kGroup) {
    const Index size = std::min(kGroup, n_ - k);
    solveSmallLower(A.from(k, k), x.from(k, 0), size, 1);
    subtractProduct(A.from(k + kGroup, k), x.from(k, 0), x.from(k + kGroup, 0), rows_ - k - kGroup, 1, size);
  }
  for (Index k = rows_ - kGroup; k >= 0; k -= kGroup) {
    const Index size = std::min(kGroup, n_ - k);
    for (Index j = size; j-- > 0;) {
      const Complex f = detail::product(x.get(k + j, 0), A.get(k + j, k + j));
      x.set(k + j, 0, f);
      for (Index i = 0; i < j; ++i) x.subtract(k + i, 0, A.get(k + i, k + j), f);
    }
    subtractProduct(A.from(0, k), x.from(k, 0), x, k, 1, size);
  }
  for (Index i = 0; i < n_; ++i) b[i] = x.get(i, 0);
}

}  // namespace irk
