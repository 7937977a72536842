// Refuses residuals that remember earlier evaluations.
#pragma once

#include "irk/system.h"

namespace irk {

/// Evaluates the residual of a finite start, elsewhere, and at the same points again. A step evaluates points in any
/// order and repeats rejected ones, so that a residual that depends on earlier evaluations (a history kept in the
/// problem, a counter, a random number) is no function, and its integration means nothing. Throws Misuse, naming the
/// row and both values, if the second value differs from the first. Differences of up to 1e-7 of a row's magnitude are
/// round-off of sums in another order or of an inner iteration; a step then meets them as round-off of the residual.
/// A value that is not finite is not judged. Five evaluations, not counted; allocates.
template <class Real>
void requireNoMemory(const System<Real>& system, const State<Real>& start, const Real& t_end);

}  // namespace irk
