// Static equilibrium of a system: r(t; u, 0, x; 0, 0, z) = 0.
#pragma once

#include <functional>
#include <memory>

#include "irk/outcome.h"
#include "irk/system.h"

namespace irk {

template <class Real>
struct Equilibrium {
  Outcome outcome = Outcome::kSuccess;  ///< or kNewtonFailed, kSingular, kNotFinite
  State<Real> state;                    ///< u, x, z; v, a, k are 0. After a failure: the last iterate
  int iterations = 0;                   ///< of all load steps together
};

/// Newton's method with exact derivatives, started from u, x, z of `guess` at its t. Position constraints enter as
/// g = 0, whatever the formulation is. Uses dense matrices, for n up to some hundreds.
template <class Real>
[[nodiscard]] Equilibrium<Real> findEquilibrium(const System<Real>& system, const State<Real>& guess);

/// Makes the system under a part of its load, in [0, 1].
template <class Real>
using LoadedSystem = std::function<std::shared_ptr<const System<Real>>(const Real& load)>;

/// The same with the load increased in `load_steps` >= 1 equal steps; each step starts from the last equilibrium.
/// Stops at the first step that fails.
template <class Real>
[[nodiscard]] Equilibrium<Real> findEquilibrium(const LoadedSystem<Real>& system, const State<Real>& guess,
                                                int load_steps);

}  // namespace irk
