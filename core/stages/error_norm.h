// The error norm: weights of the state's components, and norms of errors and Newton increments.
#pragma once

#include <algorithm>

#include "irk/options.h"
#include "irk/system.h"

namespace irk {

/// Weights sc_i = atol scale_i + rtol |y_i|, so that a norm of 1 is the tolerance. HW I (II.4.10-11).
/// Errors of algebraic unknowns of index i are multiplied by h^(i-1), HW II (VII.7). Norms are doubles for every
/// scalar, since they only serve for decisions.
template <class Real>
class ErrorNorm {
 public:
  /// `scale`: magnitudes of u, v, x, z (2 nu + nx + nz); empty means 1. Throws Misuse for another length. Keeps a
  /// reference to the system's error powers.
  ErrorNorm(const System<Real>& system, const Tolerances& tolerances, const Vec<double>& scale);

  /// Leaves multipliers of position constraints out of the norm, from the next update on. For methods that do not
  /// determine them well, if they are computed anew at the end: their errors then do not enter the result.
  void leaveMultipliersOut() { leaves_multipliers_out_ = true; }

  /// Another scale of the first components, from the next update on; the others have that of the constructor.
  void setScale(const Vec<double>& first);

  /// Sets the weights from the magnitudes of `y`; call it before each step. In the absolute norm they are all atol,
  /// or atol (scale_i + |y_i|) where that is smaller, which only a scale of setScale makes.
  void update(const State<Real>& y);

  /// Writes the weights of components (u, v, x) that are zero; 2 nu + nx numbers.
  void weightsAtZero(Vec<double>& weights) const;
  /// The weights sc of (u, v, x, z); 2 nu + nx + nz numbers.
  const Vec<double>& weights() const { return weight_; }
  /// Whether the system is in index 3 (ErrorPowers::isIndex3).
  bool index3() const { return index3_; }
  /// The larger one of rtol and atol.
  double tolerance() const { return std::max(tolerances_.rtol, tolerances_.atol); }
  /// Index of the component of (u, v, x, z) that contributes most to `difference`.
  Index worst(const State<Real>& p, const State<Real>& q, double h, const Vec<double>& factor) const;

  /// Norm of the difference of two states after a step of size h. `factor` (2 nu + nx + nz numbers) multiplies the
  /// differences of the components.
  double difference(const State<Real>& p, const State<Real>& q, double h, const Vec<double>& factor) const;

  /// Norm of an error e, i.e. of its difference from zero.
  double magnitude(const State<Real>& e, double h) const;

  /// Writes n squared weights of (a, k, z) for `increment`. A change of (a, k, z) counts by its effect on
  /// (u, v, x, z): h^2 da, h da, h dk, dz. Components of index i, here of u, v, x as well, are multiplied by
  /// h^(i-1): Newton corrects those of higher index later, and its contraction is that of the others.
  void rowWeights(double h, Vec<double>& squares) const;
  /// Norm of a Newton increment dW (n x s), columns from `first` on, on up to `threads` threads. Always an RMS norm,
  /// whatever the error norm is.
  double increment(const Mat<Real>& dW, Index first, const Vec<double>& squares, int threads = 1) const;

 private:
  double weightOf(Index i, double value) const;
  double total(double sum_of_squares) const;
  double zFactor(double h, Index i) const;
  template <class F>
  void forEachPart(const State<Real>& p, const State<Real>& q, double h, const Vec<double>& factor, F&& f) const;

  Sizes sizes_;
  const ErrorPowers& powers_;
  bool index3_;
  Tolerances tolerances_;
  Vec<double> scale_;        // of u, v, x, z, as given to the constructor
  Vec<double> first_scale_;  // of setScale
  Vec<double> weight_;       // of u, v, x, z
  bool leaves_multipliers_out_ = false;
};

}  // namespace irk
