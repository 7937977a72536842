// Finds the pattern of a system's derivatives by evaluating them.
#pragma once

#include "core/derivatives/pattern.h"

namespace irk {

/// For each direction the rows where the derivative differs from zero at a random point near p. A point near p is
/// used because a derivative may happen to vanish at p. `at_p`: searches at p, too, at twice the cost. Derivatives
/// that are not finite do not count. Method: dual numbers with random combinations of directions; each interval of
/// directions is split into eight parts at a time, and intervals that share no row are evaluated together. This
/// takes about log8(n) evaluations per colour of the pattern.
template <class Real>
RowSets detectRows(const System<Real>& system, Level level, const Point<Real>& p, const Directions& directions,
                   bool at_p);

}  // namespace irk
