// Names the components in messages as their scene does.
#pragma once

#include <string>
#include <vector>

#include "irk/system.h"

namespace irk {

/// Replaces components such as "v[1]" in the message of an integration by names such as "theta'". `names`: of the
/// scene's u, v, x, z. `system`: the sizes of the formulation that was integrated. Components without a name in the
/// scene stay as they are.
std::string withNames(const std::string& message, const std::vector<std::string>& names, const Sizes& scene,
                      const Sizes& system);

}  // namespace irk
