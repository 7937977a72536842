// LU factors of eight small dense matrices side by side, real or complex, with pivots of their own.
#pragma once

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
  ComplexLanes& operator-=(const ComplexLanes& b) { return re -= b.re, im -= b.im, *this; }
};

namespace detail {

inline Lanes magnitude(const Lanes& a) { return abs(a); }
inline Lanes magnitude(const ComplexLanes& a) { return abs(a.re) + abs(a.im); }
inline Lanes inverse(const Lanes& a) { return 1.0 / a; }
inline ComplexLanes inverse(const ComplexLanes& a) {
  const Lanes f = 1.0 / (a.re * a.re + a.im * a.im);
  return {a.re * f, -a.im * f};
}
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
  explicit LaneLu(Index n) : n_(n), work_(size(n * n)), lu_(size(n * n)), pivots_(size(n)), swaps_(size(n)) {}

  /// Entry (i, j) of the matrices to be factorized next; `factorize` overwrites it.
  Value& at(Index i, Index j) { return work_[size(i + j * n_)]; }

  /// Factorizes the matrices of all lanes; only lanes of `which` get new factors.
  LaneFactors factorize(const LaneMask& which) {
    LaneFactors result;
    Lanes sum;
    for (const Value& a : work_) sum += detail::magnitude(a);
    result.not_finite = ~finite(sum) & which;
    for (Index k = 0; k < n_; ++k) {
      result.singular = result.singular | (equal(pivot(k, which), 0.0) & which);
      eliminate(k);
    }
    for (std::size_t i = 0; i < lu_.size(); ++i) lu_[i] = detail::choose(which, work_[i], lu_[i]);
    return result;
  }

  /// Solves in place, n entries.
  void solve(Value* y) const {
    for (Index k = 0; k < n_; ++k) {
      if (!swaps_[size(k)]) continue;
      for (Index i = k + 1; i < n_; ++i) swap(equal(pivots_[size(k)], static_cast<double>(i)), y[k], y[i]);
    }
    withSize<kUnrolled>(n_, [y, lu = lu_.data()](auto n) {
      const auto subtractColumn = [&](Index k, Index first, Index last) {
        const Value f = y[k];
        for (Index i = first; i < last; ++i) y[i] -= lu[i + k * n] * f;
      };
      for (Index k = 0; k < n; ++k) subtractColumn(k, k + 1, n);
      for (Index k = n; k-- > 0;) {
        y[k] = y[k] * lu[k + k * n];
        subtractColumn(k, 0, k);
      }
    });
  }

 private:
  static constexpr Index kUnrolled = 8;  // sizes up to this one have loops of their own

  static std::size_t size(Index n) { return static_cast<std::size_t>(n); }
  static void swap(const LaneMask& mask, Value& a, Value& b) {
    const Value before = a;
    a = detail::choose(mask, b, a);
    b = detail::choose(mask, before, b);
  }

  // Brings the largest entry of column k to row k, lane by lane; returns its size.
  Lanes pivot(Index k, const LaneMask& which) {
    Lanes most = detail::magnitude(at(k, k)), row = static_cast<double>(k);
    for (Index i = k + 1; i < n_; ++i) {
      const Lanes here = detail::magnitude(at(i, k));
      const LaneMask larger = less(most, here);
      most = select(larger, here, most);
      row = select(larger, static_cast<double>(i), row);
    }
    Lanes& kept = pivots_[size(k)];
    kept = select(which, row, kept);
    const LaneMask stays = equal(row, static_cast<double>(k));
    swaps_[size(k)] = (~equal(kept, static_cast<double>(k))).any();
    for (Index i = k + 1; i < n_ && (~stays).any(); ++i) {
      const LaneMask rows = equal(row, static_cast<double>(i));
      if (!rows.any()) continue;
      for (Index j = 0; j < n_; ++j) swap(rows, at(k, j), at(i, j));
    }
    return most;
  }
  void eliminate(Index k) {
    withSize<kUnrolled>(n_, [k, a = work_.data()](auto n) {
      Value* const column = a + k * n;
      const Value inverse = detail::inverse(column[k]);
      for (Index i = k + 1; i < n; ++i) column[i] = column[i] * inverse;
      for (Index j = k + 1; j < n; ++j) {
        Value* const to = a + j * n;
        const Value f = to[k];
        for (Index i = k + 1; i < n; ++i) to[i] -= column[i] * f;
      }
      column[k] = inverse;
    });
  }

  Index n_;
  std::vector<Value> work_, lu_;  // by columns; on the diagonal the inverse pivots
  std::vector<Lanes> pivots_;     // rows
  std::vector<char> swaps_;       // whether a lane changes row k
};

}  // namespace irk
