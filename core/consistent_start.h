// Consistent starts: constraints hold, and (a, k, z) follow from (u, v, x).
#pragma once

#include <string>

#include "core/linearization.h"
#include "core/outcome.h"

namespace irk {

struct StartReport {
  Outcome outcome = Outcome::kSuccess;
  std::string detail;
};

/// What is asked of a state before (a, k, z) are determined.
enum class StartCheck {
  kConstraints,  ///< a user's start: g = 0 and dg/dt = 0
  kNone,         ///< a restart after a switch: the drift of the integration is no mistake
};

/// Checks g = 0 and dg/dt = 0 at `state`, then replaces state.w by the solution of the residual at
/// Level::kAcceleration (Newton on w). Where that matrix is singular (algebraic unknowns of higher
/// index that are no multipliers of position constraints) state.w is kept if `w_required` is false
/// or it satisfies the residual; else kInconsistentStart. kNotFinite names the row.
template <class Real>
StartReport makeConsistent(const System<Real>& system, DerivativeSource source, bool w_required,
                           State<Real>& state, StartCheck check = StartCheck::kConstraints);

}  // namespace irk
