// Checks whether a system at rest stays at rest within a step, and not only at the nodes of the method.
#pragma once

#include "core/derivatives/consistent_start.h"
#include "core/stages/error_norm.h"

namespace irk {

/// Whether a RestCheck is worth its cost for a step of size h with this error, in tolerances: the error is nearly zero,
/// and the step is at least a hundredth of the whole interval.
bool mayRest(double error, double h, double length);

/// A method evaluates the equations at its nodes only. A system at rest takes long steps, and an input may vanish at
/// all nodes of such a step: for example a sine at Lobatto's nodes 0, 1/2 and 1 in a step as long as its period. Error
/// estimates do not show it, because all stages agree. Such steps are rare, so that two more evaluations cost little.
/// Owns scratch; keeps references.
template <class Real>
class RestCheck {
 public:
  RestCheck(const System<Real>& system, const ErrorNorm<Real>& norm, ConsistentStart<Real>& start);

  /// The error, in tolerances, of a step of size h from `begin` to `end` that does not change the state: h times the
  /// change of the rates (a, k) from `begin` to times within the step that are not nodes of a usual method. 0 if the
  /// step changes the state by more than a tenth of a tolerance, or if rates cannot be determined.
  double error(const State<Real>& begin, const State<Real>& end, double h);

 private:
  // Determines (a, k, z) for the state at a time later by `after`; returns false if that fails.
  bool ratesAt(const State<Real>& state, double after, State<Real>& result);

  const ErrorNorm<Real>& norm_;
  ConsistentStart<Real>& start_;
  Vec<double> all_;  // factors of the norm: 1 for (u, v, x), 0 for z
  State<Real> still_, moved_;
};

}  // namespace irk
