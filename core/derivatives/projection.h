// Velocities on dg/dt = 0 after a step: the formulation `index2_projected`.
#pragma once

#include "core/derivatives/differentiator.h"
#include "core/derivatives/rate_lu.h"
#include "irk/outcome.h"
#include "irk/statistics.h"

namespace irk {

/// M (v - v0) + G^T mu = 0, dg/dt(t, u, v) = 0: the nearest velocity in the norm of M. HW II
/// (VII.2), with the matrix of the acceleration level, D0 = [-M, -G^T; G, 0]. dg/dt is linear in v,
/// so that one solve is exact. Owns scratch.
template <class Real>
class VelocityProjection {
 public:
  /// Keeps references.
  VelocityProjection(const System<Real>& system, DerivativeSource source, Counters& counters);
  /// Changes state.v. kSingular or kNotFinite where the projection does not exist.
  [[nodiscard]] Outcome apply(State<Real>& state);
  /// First the positions on g = 0 in the same way, then the velocities. For a start of index 3, whose short
  /// steps make velocities g / h of what is left of g.
  [[nodiscard]] Outcome applyToPositions(State<Real>& state);

 private:
  Outcome solve(Level level, const State<Real>& state);

  const System<Real>& system_;
  Sizes sizes_;
  Counters& counters_;
  Differentiator<Real> differentiator_;
  Linearization<Real> D_;
  RateLu<Real> lu_;
  Vec<Real> r_;
};

}  // namespace irk
