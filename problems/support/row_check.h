// Finds a residual that writes more rows than its scene has, which would damage memory.
#pragma once

#include "irk/system.h"

namespace irk {

/// Evaluates the residual once at `start`, with room behind its n rows. Throws Misuse if it writes there; the message
/// names the row. Does nothing for a start of other sizes than the system's. Later evaluations are not checked, and
/// cost nothing more.
void requireRowsInside(const System<double>& system, const State<double>& start);

}  // namespace irk
