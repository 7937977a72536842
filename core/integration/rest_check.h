// Whether a system at rest stays at rest within a step, or only at the nodes of the method.
#pragma once

#include "core/derivatives/consistent_start.h"
#include "core/stages/error_norm.h"

namespace irk {

/// Whether a step of size h with this error, in tolerances, is worth a RestCheck: a part of at least a hundredth of the
/// whole time, and hardly an error.
bool mayRest(double error, double h, double length);

/// A method sees the equations at its nodes. A system at rest takes long steps, and an input may vanish at all nodes of
/// one: Lobatto's of three stages, 0, 1/2 and 1, in a step of the length of a sine. Estimates see nothing either, as
/// all stages agree. Such steps are rare, so that two more evaluations cost little. Owns scratch; keeps references.
template <class Real>
class RestCheck {
 public:
  RestCheck(const System<Real>& system, const ErrorNorm<Real>& norm, ConsistentStart<Real>& start);

  /// The error of a step of size h from `begin` to `end` that leaves the state as it is, in tolerances: h times what
  /// the rates (a, k) of `begin` change until times within the step that are no nodes of a usual method. 0 if the step
  /// moves the state by more than a tenth of a tolerance, and where rates are not to be had.
  double error(const State<Real>& begin, const State<Real>& end, double h);

 private:
  // (a, k, z) of the state a time later; false if they are not to be had.
  bool ratesAt(const State<Real>& state, double after, State<Real>& result);

  const ErrorNorm<Real>& norm_;
  ConsistentStart<Real>& start_;
  Vec<double> all_;  // factors of the norm: 1 for (u, v, x), 0 for z
  State<Real> still_, moved_;
};

}  // namespace irk
