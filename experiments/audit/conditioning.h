// How a system multiplies errors of its start, from its closed form alone.
#pragma once

#include <string>

#include "irk/scene.h"

namespace irk::audit {

/// The growth of a small error of the start until t_end, both measured as errors (judge.h): the largest one over the
/// numeric parameters that move the start (u, v, x) if they change by 1e-9 of their value. The closed form is evaluated
/// in 50 digits at both values, so that no run and no round-off enters. A parameter that changes the equations as well
/// contributes that sensitivity, too. Infinite if one of the two motions has ended by t_end. NaN for a scene without
/// closed form or 50 digits, or if no parameter moves its start.
double growthByClosedForm(const std::string& scene, const Settings& settings, double t_end);

}  // namespace irk::audit
