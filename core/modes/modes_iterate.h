// `iterate`: the mode is frozen in a step, which is solved again until its mode stays.
#pragma once

#include "core/steps/modes.h"

namespace irk {

Strategy<Discontinuity> iteratedModes();

}  // namespace irk
