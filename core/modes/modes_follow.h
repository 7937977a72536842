// `ignore` and `smooth`: the mode follows the solution from step to step.
#pragma once

#include "core/steps/modes.h"

namespace irk {

Strategy<Discontinuity> ignoredModes();
Strategy<Discontinuity> smoothModes();

}  // namespace irk
