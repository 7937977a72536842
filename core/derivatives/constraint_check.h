// Whether a state lies on its position constraints and within its bounds, relative to the magnitudes of its components.
#pragma once

#include <string>

#include "irk/options.h"
#include "irk/system.h"

namespace irk {

/// The system that has the position constraints: not the decorator that counts, and the inner system of a first-order
/// form, which has eliminated them.
template <class Real>
const System<Real>& constrainedIn(const System<Real>& system);

/// Checks g(t, u) = 0 and dg/dt = 0 in every formulation; the first-order form has eliminated these constraints, and
/// its inner system is checked. Returns an empty text, or which constraint is violated, by how much, and the allowed
/// value: `allowed` times the change of the constraint if every component changes by its weight. A residual far above
/// that proves that the state is wrong by as much; units and factors of constraints do not matter. IDACalcIC of
/// SUNDIALS uses weighted changes as well (Brown, Hindmarsh & Petzold, SIAM J. Sci. Comput. 19, 1998). `weights`: at
/// least 2 nu + nx numbers in the order (u, v, x). Its evaluations are not counted. Allocates.
template <class Real>
std::string constraintViolation(const System<Real>& system, const State<Real>& state, const Vec<double>& weights,
                                double allowed);

/// Returns an empty text, or which x is negative though it never is on an exact solution (System::nonNegative), by how
/// much, and the allowed value: `allowed` weights. `weights` as above. Allocates.
template <class Real>
std::string negativeComponent(const System<Real>& system, const State<Real>& state, const Vec<double>& weights,
                              double allowed);

/// The allowed violation of constraints, in weights of the error norm: 10, i.e. 10 tolerances, but relative to the
/// state not less than 1e-11 and not more than 0.1.
double allowedDrift(const Tolerances& tolerances);

}  // namespace irk
