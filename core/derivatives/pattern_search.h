// The pattern of a system's derivatives, found by evaluating them.
#pragma once

#include "core/derivatives/pattern.h"

namespace irk {

/// The rows where derivatives differ from zero at a point near p, by dual numbers in random
/// combinations: intervals of columns are halved thrice at a time, those that share no row together,
/// so that about log8(n) times the colours of the pattern are evaluated. Near p: a derivative that
/// happens to vanish at p is found. `at_p`: and at p itself, which costs as much again. What is not
/// finite is not counted.
template <class Real>
RowSets detectRows(const System<Real>& system, Level level, const Point<Real>& p,
                   const Directions& directions, bool at_p);

}  // namespace irk
