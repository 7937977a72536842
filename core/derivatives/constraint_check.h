// Whether a state lies on its position constraints, relative to the magnitudes of its components.
#pragma once

#include <string>

#include "irk/options.h"
#include "irk/system.h"

namespace irk {

/// Judges g(t, u) = 0 and dg/dt = 0, whatever the formulation; in the first-order form, which has eliminated them,
/// those of the system in it. Returns an empty text, or which constraint is violated, by how much, and what is allowed:
/// `allowed` times what a change of every component by its weight makes of the constraint. A residual far above that
/// proves that the state is wrong by as much; units and factors of constraints do not matter. IDACalcIC of SUNDIALS
/// judges by weighted changes, too (Brown, Hindmarsh & Petzold, SIAM J. Sci. Comput. 19, 1998). `weights`: at least
/// 2 nu + nx numbers in the order (u, v, x). Its evaluations are not counted. Allocates.
template <class Real>
std::string constraintViolation(const System<Real>& system, const State<Real>& state, const Vec<double>& weights,
                                double allowed);

/// How many weights of the error norm a result may be off its constraints: 10, which are 10 tolerances, but not less
/// than 1e-11 and not more than 0.1 relative.
double allowedDrift(const Tolerances& tolerances);

}  // namespace irk
