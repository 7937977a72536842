// The limits of lanes. Each function throws Misuse that names the option, the method or the property.
#pragma once

#include "core/stages/scheme.h"
#include "irk/options.h"
#include "irk/system.h"

namespace irk {

/// Returns `options` if they are in range and have the strategies of laneOptions.
IntegratorOptions legalInLanes(const IntegratorOptions& options);
void requireLaneMethod(const Scheme<double>& scheme);
/// Checks a system. `others`: the sizes of the ensemble's systems so far, or null.
void requireLaneSystem(const System<double>& system, const Sizes* others);

}  // namespace irk
