// Inverses of matrices with up to 8 rows. A product with the inverse is faster than substitution with factors, where
// each row waits for the one before. For more rows see core/linear/padded_inverse.h.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>
#include <utility>

#include "core/linear/dense_lu.h"

namespace irk {

/// Up to this many rows all columns are in registers. Measured for complex n = 8: the inverse takes no longer than the
/// factors, since its loops are vector instructions, and a product a sixth of the time of the substitutions. The
/// inverse takes 0.73, 0.91, 0.92, 0.84, 0.94 of the time of that of padded_inverse.h for complex n = 4 to 8.
inline constexpr Index kSmallInverse = 8;

/// Scratch of `invert`: a real (Parts = 1) or complex (Parts = 2) n x n matrix by columns, without gaps; all real parts
/// come before all imaginary parts. `invert` also reads and overwrites numbers behind it, whose values do not matter.
using SmallMatrix = std::array<double, static_cast<std::size_t>(2 * kSmallInverse * kSmallInverse + kSmallInverse)>;

namespace detail {

/// Vector registers of Width doubles and of Width integers.
template <Index Width>
struct RegisterOf;
template <>
struct RegisterOf<2> {
  using Numbers = double __attribute__((vector_size(16)));
  using Integers = std::int64_t __attribute__((vector_size(16)));
};
template <>
struct RegisterOf<4> {
  using Numbers = double __attribute__((vector_size(32)));
  using Integers = std::int64_t __attribute__((vector_size(32)));
};
template <>
struct RegisterOf<8> {
  using Numbers = double __attribute__((vector_size(64)));
  using Integers = std::int64_t __attribute__((vector_size(64)));
};

/// Smith's division without a branch; detail::inverse would be a call that saves and restores all columns.
[[gnu::always_inline]] inline std::array<double, 2> inverseOf(double re, double im) {
  const bool wide = std::abs(re) >= std::abs(im);
  const double larger = wide ? re : im, ratio = (wide ? im : re) / larger;
  const double scale = 1 / (larger + ratio * (wide ? im : re));
  return wide ? std::array{scale, -ratio * scale} : std::array{ratio * scale, -scale};
}

/// The columns of a small matrix in vector registers. In memory, a vector load of a column that scalar instructions
/// have just written would have to wait until they are complete.
template <int Parts, Index N>
class InRegisters {
  static constexpr Index kWidth = N <= 2 ? 2 : N <= 4 ? 4 : 8;
  using Numbers = typename RegisterOf<kWidth>::Numbers;
  using Integers = typename RegisterOf<kWidth>::Integers;

 public:
  /// Gauss-Jordan with partial pivoting; see irk::invert.
  [[gnu::always_inline]] static inline Outcome invert(double* data) {
    static_assert((Parts * N - 1) * N + kWidth <= static_cast<Index>(std::tuple_size_v<SmallMatrix>));
    InRegisters a(data);
    bool swapped = false;
    std::array<Index, static_cast<std::size_t>(N)> pivots;
#pragma GCC unroll 8
    for (Index k = 0; k < N; ++k) {
      const Index pivot = a.pivotOf(k);
      if (pivot < 0) return a.isFinite() ? Outcome::kSingular : Outcome::kNotFinite;
      pivots[static_cast<std::size_t>(k)] = pivot;
      if (pivot != k) a.swapRows(k, pivot), swapped = true;
      a.eliminate(k);
    }
    if (!a.isFinite()) return Outcome::kNotFinite;
    a.store(data);
    for (Index k = N; swapped && k-- > 0;) {
      const Index pivot = pivots[static_cast<std::size_t>(k)];
      for (Index i = 0; i < N && pivot != k; ++i) {
        std::swap(data[k * N + i], data[pivot * N + i]);
        if constexpr (Parts == 2) std::swap(data[(N + k) * N + i], data[(N + pivot) * N + i]);
      }
    }
    return Outcome::kSuccess;
  }

 private:
  [[gnu::always_inline]] explicit InRegisters(const double* data) {
    for (Index i = 0; i < kWidth; ++i) row_[i] = i;
#pragma GCC unroll 8
    for (Index j = 0; j < N; ++j) {
      load(data + j * N, re_[j]);
      if constexpr (Parts == 2) load(data + (N + j) * N, im_[j]);
    }
  }
  [[gnu::always_inline]] void store(double* data) const {  // a store reaches into the next column, which follows
#pragma GCC unroll 8
    for (Index j = 0; j < N; ++j) std::memcpy(data + j * N, &re_[j], sizeof(Numbers));
    if constexpr (Parts == 2) {
#pragma GCC unroll 8
      for (Index j = 0; j < N; ++j) std::memcpy(data + (N + j) * N, &im_[j], sizeof(Numbers));
    }
  }
  [[gnu::always_inline]] void load(const double* column, Numbers& to) const {
    std::memcpy(&to, column, sizeof(Numbers));
    to = row_ < N ? to : Numbers{};
  }
  [[gnu::always_inline]] static void addMagnitude(const Numbers& x, Numbers& sum) { sum += x < Numbers{} ? -x : x; }

  // The row of the largest number in column k, from row k on; -1 if that number is not above 0. Usually it is row k,
  // which the processor's branch prediction learns.
  [[gnu::always_inline]] Index pivotOf(Index k) {
    Numbers size{};
    addMagnitude(re_[k], size);
    if constexpr (Parts == 2) addMagnitude(im_[k], size);
    not_finite_ += size * 0.0;
    size = row_ < k ? Numbers{} - 1 : size;
    std::array<double, static_cast<std::size_t>(kWidth)> sizes, largest;
    std::memcpy(sizes.data(), &size, sizeof size);
    largest = sizes;
    for (std::size_t width = kWidth / 2; width > 0; width /= 2) {
      for (std::size_t i = 0; i < width; ++i) largest[i] = std::max(largest[i], largest[i + width]);
    }
    if (!(largest[0] > 0)) return -1;
    for (Index i = k; i < N; ++i) {
      if (sizes[static_cast<std::size_t>(i)] == largest[0]) return i;
    }
    return -1;
  }
  [[gnu::always_inline]] void swapRows(Index i, Index j) {
    const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
    const auto swap = [=](Numbers& x) {
      const double first = x[a];
      x[a] = x[b];
      x[b] = first;
    };
#pragma GCC unroll 8
    for (Index c = 0; c < N; ++c) {
      swap(re_[c]);
      if constexpr (Parts == 2) swap(im_[c]);
    }
  }
  [[gnu::always_inline]] void eliminate(Index k) {
    const Integers here = row_ == k;
    const Numbers zero{};  // x - zero copies x to all rows; a sum would lose -0
    if constexpr (Parts == 1) {
      const double inverse = 1 / re_[k][k];
      const Numbers rest = here ? zero : re_[k];
#pragma GCC unroll 8
      for (Index j = 0; j < N; ++j) {
        const Numbers f = re_[j][k] * inverse - zero;
        if (j != k) re_[j] = here ? f : re_[j] - f * rest;
      }
      re_[k] = here ? inverse - zero : -inverse * rest;
    } else {
      const auto [a, b] = inverseOf(re_[k][k], im_[k][k]);
      const Numbers re = here ? zero : re_[k], im = here ? zero : im_[k];
#pragma GCC unroll 8
      for (Index j = 0; j < N; ++j) {
        const double x = re_[j][k], y = im_[j][k];
        const Numbers f = (x * a - y * b) - zero, g = (x * b + y * a) - zero;
        if (j == k) continue;
        re_[j] = here ? f : re_[j] - (f * re - g * im);
        im_[j] = here ? g : im_[j] - (f * im + g * re);
      }
      re_[k] = here ? a - zero : b * im - a * re;
      im_[k] = here ? b - zero : -(a * im + b * re);
    }
  }
  // Whether all numbers were finite when they were in the column of a pivot.
  [[gnu::always_inline]] bool isFinite() const {
    bool finite = true;
    for (Index i = 0; i < N; ++i) finite = finite && not_finite_[i] == 0;
    return finite;
  }

  static constexpr auto kColumns = static_cast<std::size_t>(N);
  Numbers re_[kColumns], im_[kColumns];
  Numbers not_finite_{};
  Integers row_{};
};

/// The inverse of a 2 x 2 matrix (a, c; b, d by columns) is (d, -c; -b, a) / det, which is as accurate as elimination.
/// Returns false where det is round-off of its products, or where it or its square may not be represented; the matrix
/// is then unchanged.
template <int Parts>
[[gnu::always_inline]] inline bool invertTwo(double* data) {
  constexpr double kLeast = 1e-140, kMost = 1e140, kRoundOff = 8 * std::numeric_limits<double>::epsilon();
  const double a = data[0], c = data[1], b = data[2], d = data[3];
  if constexpr (Parts == 1) {
    const double det = a * d - b * c;
    const double products = std::abs(a * d) + std::abs(b * c);
    if (!(std::abs(det) > std::max(kLeast, kRoundOff * products) && std::abs(det) < kMost)) return false;
    const double f = 1 / det;
    data[0] = d * f, data[1] = -c * f, data[2] = -b * f, data[3] = a * f;
  } else {
    double* const imag = data + 4;
    const double ai = imag[0], ci = imag[1], bi = imag[2], di = imag[3];
    const double re = (a * d - ai * di) - (b * c - bi * ci), im = (a * di + ai * d) - (b * ci + bi * c);
    const double size = std::abs(re) + std::abs(im);
    const double products = (std::abs(a) + std::abs(ai)) * (std::abs(d) + std::abs(di)) +
                            (std::abs(b) + std::abs(bi)) * (std::abs(c) + std::abs(ci));
    if (!(size > std::max(kLeast, kRoundOff * products) && size < kMost)) return false;
    const double square = 1 / (re * re + im * im);
    const double f = re * square, g = -im * square;
    data[0] = d * f - di * g, data[1] = ci * g - c * f, data[2] = bi * g - b * f, data[3] = a * f - ai * g;
    imag[0] = d * g + di * f, imag[1] = -(c * g + ci * f), imag[2] = -(b * g + bi * f), imag[3] = a * g + ai * f;
  }
  return true;
}

}  // namespace detail

/// Replaces the n x n matrix at the beginning of `data` by its inverse. Returns kSuccess, kSingular or kNotFinite;
/// after a failure the entries are unspecified.
template <int Parts, Index N>
[[nodiscard]] Outcome invert(SmallMatrix& data, std::integral_constant<Index, N>) {
  static_assert(N <= kSmallInverse);
  if constexpr (N == 2) {
    if (detail::invertTwo<Parts>(data.data())) return Outcome::kSuccess;
  }
  return detail::InRegisters<Parts, N>::invert(data.data());
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
