// `locate`: the mode is frozen, and the first root of a switching function ends the step.
#pragma once

#include "core/steps/modes.h"

namespace irk {

Strategy<Discontinuity> locatedModes();

}  // namespace irk
