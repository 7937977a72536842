// Components by the names of their scene, in messages.
#pragma once

#include <string>
#include <vector>

#include "irk/system.h"

namespace irk {

/// The message of an integration with its components "v[1]" replaced by names, "theta'". `names`: of the scene's
/// u, v, x, z. `system`: the sizes of the formulation that was integrated; what the scene does not name stays.
std::string withNames(const std::string& message, const std::vector<std::string>& names, const Sizes& scene,
                      const Sizes& system);

}  // namespace irk
