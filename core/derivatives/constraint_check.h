// Whether a state satisfies what no rate and no algebraic unknown can change, relative to the magnitudes of its
// components: position constraints, and rows that read (t, u, v, x) only.
#pragma once

#include <string>

#include "irk/options.h"
#include "irk/system.h"

namespace irk {

/// The system that has the position constraints: not the decorator that counts, and the inner system of a first-order
/// form, which has eliminated them.
template <class Real>
const System<Real>& constrainedIn(const System<Real>& system);

/// Whether its time is that of the scene backwards (ReversedSystem).
template <class Real>
bool isReversed(const System<Real>& system);

/// The time t of the system in that of the scene, for messages.
template <class Real>
double sceneTime(const System<Real>& system, const Real& t);

/// Checks g(t, u) = 0 and dg/dt = 0 in every formulation; the first-order form has eliminated these constraints, and
/// its inner system is checked. Returns an empty text, or which constraint is violated, by how much, and the allowed
/// value: `allowed` times the change of the constraint if every component changes by its weight. A residual far above
/// that proves that the state is wrong by as much; units and factors of constraints do not matter. IDACalcIC of
/// SUNDIALS uses weighted changes as well (Brown, Hindmarsh & Petzold, SIAM J. Sci. Comput. 19, 1998). `weights`: at
/// least 2 nu + nx numbers in the order (u, v, x). Its evaluations are not counted. Allocates.
template <class Real>
std::string constraintViolation(const System<Real>& system, const State<Real>& state, const Vec<double>& weights,
                                double allowed);

/// The same for g = 0 of the constraints that are left out as dependent (System::leftOut): a violation shows that they
/// do not follow from the others any more, or never did away from the start.
template <class Real>
std::string leftOutViolation(const System<Real>& system, const State<Real>& state, const Vec<double>& weights,
                             double allowed);

/// The allowed violation of constraints, in weights of the error norm: 10, i.e. 10 tolerances, but relative to the
/// state not less than 1e-11 and not more than 0.1.
double allowedDrift(const Tolerances& tolerances);

/// Checks the rows of the residual at Level::kAcceleration that read neither a, k nor z, as 0 = x - f(t) of index 2.
/// Where such a row is violated, because a mode has changed or a start is inconsistent, only a jump of u, v or x could
/// satisfy it, and a system without `jump` there has no solution; a step would turn the violation into z of its size
/// divided by h. Returns an empty text, or the first violated row with its time, its value and the allowed one:
/// `allowed` times its change if u, v, x change by their weights (2 nu + nx numbers, in this order). Its evaluations
/// are not counted. Allocates.
template <class Real>
std::string fixedRowViolation(const System<Real>& system, const State<Real>& state, const Vec<double>& weights,
                              double allowed);

/// `allowed` after a restart, in weights of the error norm: as for constraints (allowedDrift). With fixed steps, where
/// Newton's method leaves round-off and the weights are magnitudes, it is 1e-7, as for starts.
double allowedInFixedRows(const IntegratorOptions& options);

}  // namespace irk
