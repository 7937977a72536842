// Static equilibrium: the residual of a system at rest, r(t; u, 0, x; 0, 0, z) = 0.
#pragma once

#include <functional>
#include <memory>

#include "irk/outcome.h"
#include "irk/system.h"

namespace irk {

template <class Real>
struct Equilibrium {
  Outcome outcome = Outcome::kSuccess;  ///< kNewtonFailed, kSingular, kNotFinite
  State<Real> state;   ///< u, x, z; v, a, k are 0. The last iterate after a failure
  int iterations = 0;  ///< of all load steps
};

/// Newton with exact derivatives from `guess` (its u, x, z at its t). Position constraints enter as
/// g = 0, whatever the formulation. Dense: for n up to some hundreds.
template <class Real>
[[nodiscard]] Equilibrium<Real> findEquilibrium(const System<Real>& system,
                                                const State<Real>& guess);

/// The system under a part of its load, in [0, 1].
template <class Real>
using LoadedSystem = std::function<std::shared_ptr<const System<Real>>(const Real& load)>;

/// The same in `load_steps` >= 1 equal steps of the load, each from the equilibrium before.
template <class Real>
[[nodiscard]] Equilibrium<Real> findEquilibrium(const LoadedSystem<Real>& system,
                                                const State<Real>& guess, int load_steps);

}  // namespace irk
