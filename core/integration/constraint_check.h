// Whether a state lies on its position constraints as closely as the tolerance asks for.
#pragma once

#include <string>

#include "core/stages/error_norm.h"

namespace irk {

/// g(t, u) = 0 and dg/dt = 0 at the end of an integration, whatever the formulation. A state within
/// one tolerance of a consistent one can have a residual of what a change of one tolerance in every
/// component makes of it; a residual far above that proves that the state is wrong by at least as much.
/// In the first-order form, which has eliminated them, the constraints of the system in it. Owns scratch; keeps
/// references.
template <class Real>
class ConstraintCheck {
 public:
  ConstraintCheck(const System<Real>& system, const ErrorNorm<Real>& norm, const Tolerances& tolerances);

  /// Empty, or which constraint is violated, by how much, and what is allowed: 20 tolerances, not
  /// less than 2e-11 and not more than 0.1 relative. The norm's weights must be those of the state.
  std::string violation(const State<Real>& state);

 private:
  std::string violation(Level level, const State<Real>& state);
  void residual(Level level, const State<Real>& state, Vec<Real>& r);

  const System<Real>& system_;       // of the integration
  const System<Real>& constrained_;  // that has the constraints
  const ErrorNorm<Real>& norm_;
  double allowed_;  // in units of the norm's weights
  State<Real> moved_;
  Vec<Real> r_, moved_r_;
  Vec<double> change_;
};

}  // namespace irk
