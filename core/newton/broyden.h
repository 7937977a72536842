// Broyden's "good" rank-one updates of a simplified Newton matrix, from the increments alone.
#pragma once

#include <array>

#include "core/base/threads.h"
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
  BroydenUpdates(Index n, Index stages, int threads = 1)
      : n_(n), threads_(threads), increments_(n * stages, kMax), weights_(n < kRepeatedBelow ? n * stages : n) {}

  /// Begins a new iteration with the simplified matrix; `on`: whether to update it. `squares`: n squared weights of the
  /// inner product.
  void begin(bool on, const Vec<double>& squares) {
    count_ = 0, frozen_ = !on;
    for (Index j = 0; on && j < weights_.size(); j += n_) {
      for (Index i = 0; i < n_; ++i) weights_[j + i] = Real(squares[i]);
    }
  }

  /// Replaces v = M^-1 R by the corrected increment, in place (n s numbers).
  void apply(VecView<Real>& v) {
    if (count_ == 0) return;
    for (Index i = 0; i + 1 < count_; ++i) {
      const Real factor = part(v, i);
      inParts(threads_, v.size(), [&](Index first, Index last) {
        v.segment(first, last - first) += factor * increments_.col(i + 1).segment(first, last - first);
      });
    }
    if (frozen_) return;
    const Real alpha = part(v, count_ - 1);
    frozen_ = !(alpha < Real(0.5));
    if (frozen_) return;
    const Real factor = Real(1) / (Real(1) - alpha);
    inParts(threads_, v.size(), [&](Index first, Index last) { v.segment(first, last - first) *= factor; });
  }
  /// Records that the increment d from `apply` was taken.
  void learn(const VecView<Real>& d) {
    if (frozen_) return;
    frozen_ = count_ == kMax;
    if (frozen_) return;
    const Real square = product(d, d);
    if (!(square > Real(0))) {
      frozen_ = true;
      return;
    }
    squares_[static_cast<std::size_t>(count_)] = square;
    copyOnThreads(threads_, d.data(), d.size(), increments_.col(count_++).data());
  }

 private:
  static constexpr Index kMax = 8;

  // <v, d_i> / |d_i|^2. The weighted increments W d_i are not stored: with many unknowns they would be as large as the
  // increments.
  Real part(const VecView<Real>& v, Index i) const {
    return product(v, increments_.col(i)) / squares_[static_cast<std::size_t>(i)];
  }
  // <a, b>
  template <class A, class B>
  Real product(const A& a, const B& b) const {
    const Index length = weights_.size();
    return sumOnThreads<Real>(threads_, a.size() / length, length, [&](Index i) {
      return Real(a.segment(i * length, length).dot(weights_.cwiseProduct(b.segment(i * length, length))));
    });
  }

  // With fewer unknowns one long sum is faster than one for each stage.
  static constexpr Index kRepeatedBelow = 64;

  Index n_;
  int threads_;
  Mat<Real> increments_;            // d_i
  Vec<Real> weights_;               // the diagonal of W, of all stages or, where it is long, of one
  std::array<Real, kMax> squares_;  // |d_i|^2
  Index count_ = 0;
  bool frozen_ = false;
};

}  // namespace irk
