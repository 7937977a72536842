// Looks at what the functions of a scene behind irk/scene_c.h write, once, at its start.
#pragma once

#include "experiments/own/foreign/foreign_model.h"

namespace irk::own {

/// Calls each function that writes an array once, with room around the array. Throws Misuse for a function that writes
/// outside or leaves a number out, for one that changes its arguments, and for a Jacobian that is not the derivative of
/// the rows near the start. `d`: the discrete state there.
void requireGoodFunctions(const ForeignModel& model, const std::vector<double>& point, const std::vector<double>& d);

}  // namespace irk::own
