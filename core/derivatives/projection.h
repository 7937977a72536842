// Projects velocities onto dg/dt = 0: after each step of the formulation `index2_projected`, and at the end of index 3.
#pragma once

#include "core/derivatives/differentiator.h"
#include "core/derivatives/rate_lu.h"
#include "irk/outcome.h"
#include "irk/statistics.h"

namespace irk {

/// Solves M (v - v0) + G^T mu = 0, dg/dt(t, u, v) = 0: v is the velocity nearest to v0 in the norm of M. HW II
/// (VII.2). The matrix is that of the acceleration level, D0 = [-M, -G^T; G, 0]. dg/dt is linear in v, so that
/// one solve is exact. Owns scratch.
template <class Real>
class VelocityProjection {
 public:
  /// Keeps references to the system and the counters.
  VelocityProjection(const System<Real>& system, DerivativeSource source, Counters& counters);
  /// Replaces state.v by its projection. Returns kSingular or kNotFinite, with the state unchanged, if there is none.
  [[nodiscard]] Outcome apply(State<Real>& state);
  /// Projects the positions onto g = 0 in the same way, then the velocities. For a start in the index-3 formulation:
  /// there a remaining g enters the velocities as g / h, which is large for a short step. A failure may leave
  /// projected positions with unprojected velocities.
  [[nodiscard]] Outcome applyToPositions(State<Real>& state);
  /// For another integration, which must not depend on the points of this one.
  void forgetPattern() { differentiator_.forgetPattern(); }

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
