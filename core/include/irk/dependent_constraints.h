// Position constraints that follow from the others: a rod too many in a mechanism.
#pragma once

#include <vector>

#include "irk/system.h"

namespace irk {

/// The numbers, ascending, of the position constraints whose gradients depend on those of the others at `start` (in the
/// scene's unknowns), for SystemOptions::left_out; empty if all are independent. A rank-revealing factorization chooses
/// those that stay: QR of G^T with column pivots (Golub & Van Loan, section 5.4.2), each gradient divided by its
/// length. A start is consistent to eight digits, and so is a dependence: what is left of a gradient besides those
/// chosen before it counts from 1e-7 of its length on. `system`: of the problem in formulation `index2`. `scale`:
/// magnitudes of (u, v, x, z), as for Integrator; empty means 1. Allocates.
///
///   SystemOptions options;
///   options.left_out = dependentConstraints(*makeSystem<double>(problem), start);
///   Integrator<double> integrator(makeSystem<double>(problem, options), ...);
template <class Real>
std::vector<Index> dependentConstraints(const System<Real>& system, const State<Real>& start,
                                        const Vec<double>& scale = {});

}  // namespace irk
