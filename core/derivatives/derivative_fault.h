// Says which derivative of a residual is not finite, where, and why that may be.
#pragma once

#include <string>

#include "irk/options.h"
#include "irk/system.h"

namespace irk {

/// For a state where r is finite at Level::kAcceleration but dr/d(a, k, z) is not: the first row whose derivative is
/// not finite, the component of (u, v, x) beside whose value it is finite, and what may help; one line. The usual cause
/// is a function whose derivative is 0/0 at this point, such as sqrt(v v) at v = 0. Costs about log2(n) evaluations
/// over dual numbers. Allocates.
template <class Real>
std::string derivativeFault(const System<Real>& system, DerivativeSource source, const State<Real>& state);

}  // namespace irk
