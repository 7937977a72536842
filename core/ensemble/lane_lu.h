// LU factors of eight small dense matrices side by side, real or complex, with pivots of their own.
#pragma once

#include <array>
#include <type_traits>
#include <vector>

#include "core/base/small_size.h"
#include "core/ensemble/lane_mask.h"
#include "irk/scalar.h"

namespace irk {

/// Eight complex numbers.
struct ComplexLanes {
  Lanes re, im;

  friend ComplexLanes operator*(const ComplexLanes& a, const ComplexLanes& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
};

namespace detail {

inline Lanes magnitude(const Lanes& a) { return abs(a); }
inline Lanes magnitude(const ComplexLanes& a) { return abs(a.re) + abs(a.im); }
inline Lanes inverse(const Lanes& a) { return 1.0 / a; }
inline ComplexLanes inverse(const ComplexLanes& a) {
  const Lanes f = 1.0 / (a.re * a.re + a.im * a.im);
  return {a.re * f, -a.im * f};
}
/// c -= a b
inline void subtractProduct(const Lanes& a, const Lanes& b, Lanes& c) { c -= a * b; }
inline void subtractProduct(const ComplexLanes& a, const ComplexLanes& b, ComplexLanes& c) {
  c.re = c.re - a.re * b.re + a.im * b.im;
  c.im = c.im - a.re * b.im - a.im * b.re;
}
inline void load(const Lanes* from, Index i, Lanes& to) { to = from[i]; }
inline void load(const Lanes* from, Index i, ComplexLanes& to) { to = {from[2 * i], from[2 * i + 1]}; }
inline void store(const Lanes& x, Index i, Lanes* to) { to[i] = x; }
inline void store(const ComplexLanes& x, Index i, Lanes* to) { to[2 * i] = x.re, to[2 * i + 1] = x.im; }
inline Lanes choose(const LaneMask& mask, const Lanes& yes, const Lanes& no) { return select(mask, yes, no); }
inline ComplexLanes choose(const LaneMask& mask, const ComplexLanes& yes, const ComplexLanes& no) {
  return {select(mask, yes.re, no.re), select(mask, yes.im, no.im)};
}

}  // namespace detail

/// The results of a factorization, by lanes.
struct LaneFactors {
  LaneMask singular, not_finite;
  LaneMask failed() const { return singular | not_finite; }
};

/// Value: Lanes or ComplexLanes. Owns factors and scratch.
template <class Value>
class LaneLu {
 public:
  explicit LaneLu(Index n) : n_(n), lu_(size(n * n)), column_(size(n)), pivots_(size(n)), swaps_(size(n)) {
    for (Index k = 0; k < n; ++k) pivots_[size(k)] = static_cast<double>(k);
  }

  /// Factorizes the matrices with entries entry(i, j); only lanes of `which` get new factors.
  ///
  /// By columns: the factors to the left of a column are applied to it while its numbers stay in vector registers, so
  /// that each number is written once.
  template <class Entry>
  LaneFactors factorize(const LaneMask& which, const Entry& entry) {
    LaneFactors result;
    Lanes not_finite;
    withSize<kUnrolled>(n_, [&](auto n) {
      if constexpr (std::is_same_v<decltype(n), Index>) {
        for (Index j = 0; j < n; ++j) factorizeColumn<0>(j, which, entry, column_.data(), result, not_finite);
      } else {
        constexpr Index N = decltype(n)::value;
        for (Index j = 0; j < N; ++j) {
          std::array<Value, size(N)> column;
          factorizeColumn<N>(j, which, entry, column.data(), result, not_finite);
        }
      }
    });
    result.not_finite = ~equal(not_finite, 0.0) & which;
    return result;
  }

  /// Solves in place, n entries; a complex one is its real part and, after it, its imaginary part.
  void solve(Lanes* y) {
    withSize<kUnrolled>(n_, [this, y](auto n) {
      if constexpr (std::is_same_v<decltype(n), Index>) {
        solveIn<0>(column_.data(), y);
      } else {
        constexpr Index N = decltype(n)::value;
        std::array<Value, size(N)> column;
        solveIn<N>(column.data(), y);
      }
    });
  }

 private:
  static constexpr Index kUnrolled = 8;  // sizes N up to this one have loops of their own; N = 0: any size

  static constexpr std::size_t size(Index n) { return static_cast<std::size_t>(n); }
  template <Index N>
  [[gnu::always_inline]] Index rows() const {
    return N > 0 ? N : n_;
  }
  // Row k of `column` changes places with the row of pivot k, which is below.
  template <Index N>
  [[gnu::always_inline]] void swapRows(Index k, Value* column) const {
    const Index n = rows<N>();
    if (!swaps_[size(k)]) return;
#pragma GCC unroll 8
    for (Index i = k + 1; i < n; ++i) {
      const LaneMask mask = equal(pivots_[size(k)], static_cast<double>(i));
      const Value before = column[k];
      column[k] = detail::choose(mask, column[i], before);
      column[i] = detail::choose(mask, before, column[i]);
    }
  }
  // Subtracts column[k] times column k of the factors, rows first to last - 1.
  template <Index N>
  [[gnu::always_inline]] void subtract(Index k, Index first, Index last, Value* column) const {
    const Index n = rows<N>();
    const Value f = column[k];
#pragma GCC unroll 8
    for (Index i = first; i < last; ++i) detail::subtractProduct(lu_[size(i + k * n)], f, column[i]);
  }

  template <Index N, class Entry>
  [[gnu::always_inline]] void factorizeColumn(Index j, const LaneMask& which, const Entry& entry, Value* c,
                                              LaneFactors& result, Lanes& not_finite) {
    const Index n = rows<N>();
    Lanes sum;
#pragma GCC unroll 8
    for (Index i = 0; i < n; ++i) {
      c[i] = entry(i, j);
      sum += detail::magnitude(c[i]);
    }
    not_finite += sum * 0.0;
#pragma GCC unroll 8
    for (Index k = 0; k < n; ++k) {
      if (k < j) {
        swapRows<N>(k, c);
        subtract<N>(k, k + 1, n, c);
      } else if (k == j) {
        pivot<N>(k, which, c, result);
      }
    }
    Value* const factors = lu_.data() + j * n;
#pragma GCC unroll 8
    for (Index i = 0; i < n; ++i) factors[i] = detail::choose(which, c[i], factors[i]);
  }

  // Brings the largest entry of column k to row k, lane by lane, and divides those below by it.
  template <Index N>
  [[gnu::always_inline]] void pivot(Index k, const LaneMask& which, Value* c, LaneFactors& result) {
    const Index n = rows<N>();
    const Lanes first = detail::magnitude(c[k]);
    Lanes most = first;
#pragma GCC unroll 8
    for (Index i = k + 1; i < n; ++i) most = largest(most, detail::magnitude(c[i]));
    Lanes row = static_cast<double>(k);
    LaneMask open = which & ~equal(first, most);
    if (open.any()) {
#pragma GCC unroll 8
      for (Index i = k + 1; i < n; ++i) {
        const LaneMask here = open & equal(detail::magnitude(c[i]), most);
        row = select(here, static_cast<double>(i), row);
        open = open & ~here;
      }
    }
    result.singular = result.singular | (equal(most, 0.0) & which);
    Lanes& kept = pivots_[size(k)];
    kept = select(which, row, kept);
    swaps_[size(k)] = (~equal(kept, static_cast<double>(k))).any();
    swapRows<N>(k, c);
    c[k] = detail::inverse(c[k]);
#pragma GCC unroll 8
    for (Index i = k + 1; i < n; ++i) c[i] = c[i] * c[k];
  }

  template <Index N>
  [[gnu::always_inline]] void solveIn(Value* column, Lanes* y) const {
    const Index n = rows<N>();
#pragma GCC unroll 8
    for (Index i = 0; i < n; ++i) detail::load(y, i, column[i]);
#pragma GCC unroll 8
    for (Index k = 0; k < n; ++k) {
      swapRows<N>(k, column);
      subtract<N>(k, k + 1, n, column);
    }
#pragma GCC unroll 8
    for (Index k = n - 1; k >= 0; --k) {
      column[k] = column[k] * lu_[size(k + k * n)];
      subtract<N>(k, 0, k, column);
    }
#pragma GCC unroll 8
    for (Index i = 0; i < n; ++i) detail::store(column[i], i, y);
  }

  Index n_;
  std::vector<Value> lu_;      // by columns; on the diagonal the inverse pivots; column k of L: rows after exchange k
  std::vector<Value> column_;  // scratch
  std::vector<Lanes> pivots_;  // rows
  std::vector<char> swaps_;    // whether a lane changes row k
};

}  // namespace irk
