// Broyden's "good" rank-one updates of a simplified Newton matrix, from the increments alone.
#pragma once

#include "irk/scalar.h"

namespace irk {

/// Deuflhard, Newton Methods for Nonlinear Problems, 2.1.4, algorithm QNERR, in an inner product with
/// weights: with M the simplified matrix and d_0, d_1, ... the increments so far,
///   v = M^-1 R;  v += <v, d_{i-1}> / |d_{i-1}|^2 d_i, i = 1 .. m - 1;  d_m = v / (1 - alpha),
///   alpha = <v, d_{m-1}> / |d_{m-1}|^2.
/// Converges superlinearly at the cost of some dot products per iteration. Makes at most `kMax` updates, and none after
/// one with alpha >= 1/2, which would not be safe: the matrix then stays as it is.
template <class Real>
class BroydenUpdates {
 public:
  BroydenUpdates(Index n, Index stages) : n_(n), increments_(n * stages, kMax), weighted_(n * stages, kMax) {}

  /// Begins a new iteration with the simplified matrix; `on`: whether to update it.
  void begin(bool on) { count_ = 0, frozen_ = !on; }

  /// Replaces v = M^-1 R by the corrected increment, in place (n s numbers).
  void apply(VecView<Real>& v) {
    if (count_ == 0) return;
    for (Index i = 0; i + 1 < count_; ++i) v += v.dot(weighted_.col(i)) * increments_.col(i + 1);
    if (frozen_) return;
    const Real alpha = v.dot(weighted_.col(count_ - 1));
    frozen_ = !(alpha < Real(0.5));
    if (!frozen_) v *= Real(1) / (Real(1) - alpha);
  }
  /// Records that the increment d from `apply` was taken. `squares`: n squared weights of the inner product.
  void learn(const VecView<Real>& d, const Vec<double>& squares) {
    if (frozen_) return;
    frozen_ = count_ == kMax;
    if (frozen_) return;
    auto weighted = weighted_.col(count_);
    for (Index j = 0; j < d.size(); j += n_) {
      for (Index i = 0; i < n_; ++i) weighted[j + i] = Real(squares[i]) * d[j + i];
    }
    const Real square = d.dot(weighted);
    if (!(square > Real(0))) {
      frozen_ = true;
      return;
    }
    weighted /= square;
    increments_.col(count_++) = d;
  }

 private:
  static constexpr Index kMax = 8;

  Index n_;
  Mat<Real> increments_, weighted_;  // d_i and its dual, W d_i / |d_i|^2
  Index count_ = 0;
  bool frozen_ = false;
};

}  // namespace irk
