// The error norm: weights of the state's components, and the norms built on them.
#pragma once

#include "irk/options.h"
#include "irk/system.h"

namespace irk {

/// Weights sc_i = atol scale_i + rtol |y_i|, so that a norm of 1 is the tolerance. HW I (II.4.10-11).
/// Algebraic unknowns of index i carry h^(i-1), HW II (VII.7). Norms are doubles for every scalar: they
/// decide, they are not results.
template <class Real>
class ErrorNorm {
 public:
  /// `scale`: magnitudes of u, v, x, z; empty = 1. Keeps a reference to the system.
  ErrorNorm(const System<Real>& system, const Tolerances& tolerances, const Vec<double>& scale);

  /// From the next update on multipliers of position constraints count nothing: where a method does not
  /// determine them and they are solved anew at the end, their errors are nobody's.
  void leaveMultipliersOut() { leaves_multipliers_out_ = true; }

  /// Weights from the magnitudes of `y`, before a step. Absolute norm: weights atol.
  void update(const State<Real>& y);

  /// sc of (u, v, x, z), 2 nu + nx + nz.
  const Vec<double>& weights() const { return weight_; }
  /// The component of (u, v, x, z) with the largest part in `difference`.
  Index worst(const State<Real>& p, const State<Real>& q, double h, const Vec<double>& factor) const;

  /// Norm of the difference of two states after a step of size h; `factor` (2 nu + nx + nz):
  /// multiplies each component's difference.
  double difference(const State<Real>& p, const State<Real>& q, double h,
                    const Vec<double>& factor) const;

  /// Of an error e itself: the difference to zero.
  double magnitude(const State<Real>& e, double h) const;

  /// The square of what one unit in row i of (a, k, z) counts by its effect on (u, v, x, z): h^2 da,
  /// h da, h dk, dz; components of index i, of u, v, x as well, carry h^(i-1): Newton corrects those of
  /// higher index later, and its contraction is that of the others. n entries, for `increment`.
  void rowWeights(double h, Vec<double>& squares) const;
  /// Norm of a Newton increment dW (columns from `first`). RMS whatever the error norm is.
  double increment(const Mat<Real>& dW, Index first, const Vec<double>& squares) const;

 private:
  double total(double sum_of_squares) const;
  double zFactor(double h, Index i) const;
  template <class F>
  void forEachPart(const State<Real>& p, const State<Real>& q, double h, const Vec<double>& factor,
                   F&& f) const;

  Sizes sizes_;
  const ErrorPowers& powers_;
  Tolerances tolerances_;
  Vec<double> scale_;   // u, v, x, z
  Vec<double> weight_;  // the same
  bool leaves_multipliers_out_ = false;
};

}  // namespace irk
