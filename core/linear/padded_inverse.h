// Inverses of matrices with 9 to 32 rows. A product with the inverse is faster than substitution with factors, where
// each row waits for the one before. For fewer rows see core/linear/small_inverse.h.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>

#include "core/linear/small_inverse.h"

namespace irk {

/// Numbers in a vector register.
inline constexpr Index kPaddedLanes = std::clamp<Index>(Eigen::internal::packet_traits<double>::size, 2, 8);

/// The most rows of a matrix here. At 31 rows the inverse takes 1.1 times as long as the factors.
inline constexpr Index kMostPadded = 32;

/// Blocks of the Newton matrix with up to this many unknowns are inverted, but see BlockInverses::pay. Measured for
/// complex matrices, inverse over DenseLu's factors, and product over substitutions: with AVX-512, n = 9: 0.9 and 0.17,
/// 14: 0.95 and 0.11, 20: 0.85 and 0.15, 31: 1.1 and 0.15; with AVX2, n = 9: 1.5 and 0.5, 14: 1.5 and 0.35. Real
/// matrices gain more. A Newton matrix is used at least three times as a rule. With registers of two numbers (SSE2) the
/// inverse takes three times as long as the factors.
inline constexpr Index kMostInverted = kPaddedLanes < 4 ? kSmallInverse : kMostPadded;

/// Rows of a column in memory: n, and zeros up to a multiple of 8.
constexpr Index paddedRows(Index n) { return (n + 7) / 8 * 8; }
/// Numbers of a complex n x n matrix in memory: the columns of all real parts, then those of all imaginary parts.
constexpr Index paddedSize(Index n) { return 2 * n * paddedRows(n); }

namespace detail {

/// A real (Parts = 1) or complex (Parts = 2) n x n matrix by columns of 8 Groups rows. Does not own its numbers.
template <int Parts, Index Groups>
class Padded {
 public:
  Padded(double* data, Index n) : n_(n), re_(data), im_(data + n * kRows) {}

  /// Gauss-Jordan with partial pivoting; see irk::invertPadded. Rows are not exchanged: the pivot of a column is the
  /// largest number in the rows that were not the pivot's row of an earlier column, and rows and columns are put in
  /// order at the end.
  Outcome invert() {
    Rows row, free;
    for (Index i = 0; i < kRows; ++i) row[index(i / kPaddedLanes)][index(i % kPaddedLanes)] = i;
    for (std::size_t r = 0; r < kRegisters; ++r) free[r] = row[r] < n_;
    Column not_finite{};
    std::array<Index, index(kRows)> pivots;
    bool in_order = true;
    Outcome outcome = Outcome::kSuccess;
    for (Index k = 0; k < n_ && outcome == Outcome::kSuccess; ++k) {
      const Index pivot = pivotOf(k, free, not_finite);
      if (pivot < 0) {
        outcome = Outcome::kSingular;
        continue;
      }
      pivots[index(k)] = pivot;
      in_order = in_order && pivot == k;
      Rows here;
      for (std::size_t r = 0; r < kRegisters; ++r) {
        here[r] = row[r] == pivot;
        free[r] &= ~here[r];
      }
      eliminate(k, pivot, here);
    }
    for (Index i = 0; i < n_; ++i) {
      if (not_finite[index(i / kPaddedLanes)][index(i % kPaddedLanes)] != 0) return Outcome::kNotFinite;
    }
    if (outcome == Outcome::kSuccess && !in_order) putInOrder(pivots);
    return outcome;
  }

  /// y + i z := A (y + i z)
  void multiply(double* y, double* z) const {
    Column re{}, im{}, re_of_z{}, im_of_y{};  // sums that do not wait for each other
    for (Index j = 0; j < n_; ++j) {
      for (std::size_t r = 0; r < kRegisters; ++r) {
        re[r] += at(re_, j, r) * y[j];
        if constexpr (Parts == 2) {
          re_of_z[r] += at(im_, j, r) * z[j];
          im[r] += at(re_, j, r) * z[j];
          im_of_y[r] += at(im_, j, r) * y[j];
        }
      }
    }
    alignas(64) std::array<Numbers, kRegisters> sum;
    for (std::size_t r = 0; r < kRegisters; ++r) sum[r] = re[r] - re_of_z[r];
    std::memcpy(y, &sum, static_cast<std::size_t>(n_) * sizeof(double));
    if constexpr (Parts == 1) return;
    for (std::size_t r = 0; r < kRegisters; ++r) sum[r] = im[r] + im_of_y[r];
    std::memcpy(z, &sum, static_cast<std::size_t>(n_) * sizeof(double));
  }

 private:
  static constexpr std::size_t index(Index i) { return static_cast<std::size_t>(i); }
  static constexpr Index kRows = 8 * Groups;
  static constexpr std::size_t kRegisters = index(kRows / kPaddedLanes);
  using Numbers = typename RegisterOf<kPaddedLanes>::Numbers;
  using Integers = typename RegisterOf<kPaddedLanes>::Integers;
  using Column = std::array<Numbers, kRegisters>;
  using Rows = std::array<Integers, kRegisters>;

  static_assert(EIGEN_DEFAULT_ALIGN_BYTES >= sizeof(Numbers));
  // gcc and clang let a vector alias its elements.
  static Numbers& at(double* plane, Index column, std::size_t r) {
    return reinterpret_cast<Numbers*>(plane + column * kRows)[r];
  }

  // The row of the largest number in column k among the free ones; -1 if that number is not above 0. Usually it is row
  // k, which the processor's branch prediction learns.
  Index pivotOf(Index k, const Rows& free, Column& not_finite) const {
    alignas(64) std::array<double, index(kRows)> sizes;
    Numbers most = Numbers{} - 1;
    for (std::size_t r = 0; r < kRegisters; ++r) {
      const Numbers x = at(re_, k, r);
      Numbers size = x < Numbers{} ? -x : x;
      if constexpr (Parts == 2) {
        const Numbers y = at(im_, k, r);
        size += y < Numbers{} ? -y : y;
      }
      not_finite[r] += size * 0.0;
      size = free[r] ? size : Numbers{} - 1;
      std::memcpy(sizes.data() + r * index(kPaddedLanes), &size, sizeof size);
      most = most < size ? size : most;
    }
    double largest = most[0];
    for (std::size_t i = 1; i < index(kPaddedLanes); ++i) largest = std::max(largest, most[i]);
    if (!(largest > 0)) return -1;
    if (sizes[index(k)] == largest) return k;
    for (Index i = 0; i < n_; ++i) {
      if (sizes[index(i)] == largest) return i;
    }
    return -1;
  }

  void eliminate(Index k, Index pivot, const Rows& here) {
    const Numbers zero{};  // x - zero copies x to all rows; a sum would lose -0
    Column re, im;         // column k without the pivot
    for (std::size_t r = 0; r < kRegisters; ++r) re[r] = here[r] ? zero : at(re_, k, r);
    if constexpr (Parts == 1) {
      const double inverse = 1 / re_[k * kRows + pivot];
      for (Index j = 0; j < n_; ++j) {
        const Numbers f = re_[j * kRows + pivot] * inverse - zero;
        for (std::size_t r = 0; r < kRegisters; ++r) {
          Numbers& x = at(re_, j, r);
          x = here[r] ? f : x - f * re[r];
        }
      }
      for (std::size_t r = 0; r < kRegisters; ++r) at(re_, k, r) = here[r] ? inverse - zero : -inverse * re[r];
    } else {
      for (std::size_t r = 0; r < kRegisters; ++r) im[r] = here[r] ? zero : at(im_, k, r);
      const auto [a, b] = inverseOf(re_[k * kRows + pivot], im_[k * kRows + pivot]);
      for (Index j = 0; j < n_; ++j) {
        const double x = re_[j * kRows + pivot], y = im_[j * kRows + pivot];
        const Numbers f = (x * a - y * b) - zero, g = (x * b + y * a) - zero;
        for (std::size_t r = 0; r < kRegisters; ++r) {
          Numbers &p = at(re_, j, r), &q = at(im_, j, r);
          p = here[r] ? f : p - (f * re[r] - g * im[r]);
          q = here[r] ? g : q - (f * im[r] + g * re[r]);
        }
      }
      for (std::size_t r = 0; r < kRegisters; ++r) {
        at(re_, k, r) = here[r] ? a - zero : b * im[r] - a * re[r];
        at(im_, k, r) = here[r] ? b - zero : -(a * im[r] + b * re[r]);
      }
    }
  }

  // With p the pivots, row p_k and column k hold row k and column p_k of the inverse.
  void putInOrder(const std::array<Index, index(kRows)>& p) {
    std::array<double, index(kRows * kRows)> copy;
    for (double* const plane : {re_, im_}) {
      std::copy_n(plane, n_ * kRows, copy.data());
      for (Index k = 0; k < n_; ++k) {
        double* const to = plane + p[index(k)] * kRows;
        for (Index i = 0; i < n_; ++i) to[i] = copy[index(k * kRows + p[index(i)])];
      }
      if constexpr (Parts == 1) return;
    }
  }

  Index n_;
  double *re_, *im_;
};

/// Calls f(matrix) with the n x n matrix in `data`.
template <int Parts, class F>
decltype(auto) withPadded(double* data, Index n, const F& f) {
  static_assert(kMostPadded == 32);
  if (n <= 16) return f(Padded<Parts, 2>(data, n));
  if (n <= 24) return f(Padded<Parts, 3>(data, n));
  return f(Padded<Parts, 4>(data, n));
}

}  // namespace detail

/// Replaces an n x n matrix, kSmallInverse < n <= kMostPadded, by its inverse. `data`: its columns as paddedRows and
/// paddedSize say, a real one (Parts = 1) without imaginary parts; aligned to a register, as Eigen's vectors are.
/// Returns kSuccess, kSingular or kNotFinite; after a failure the entries are unspecified.
template <int Parts>
[[nodiscard]] Outcome invertPadded(double* data, Index n) {
  return detail::withPadded<Parts>(data, n, [](auto matrix) { return matrix.invert(); });
}

/// Reads `data` only: y := A y for a real matrix; y + i z := A (y + i z) for a complex one. n numbers each.
template <int Parts>
void multiplyPadded(double* data, Index n, double* y, double* z = nullptr) {
  detail::withPadded<Parts>(data, n, [=](const auto& matrix) { matrix.multiply(y, z); });
}

}  // namespace irk
