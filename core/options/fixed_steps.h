// Steps of one size.
#pragma once

#include "irk/options.h"

namespace irk {

/// Whether all steps have the size `options.h`, without controller, tolerance and error estimate.
constexpr bool hasFixedSteps(const StepOptions& options) { return options.control == StepControl::kFixed; }

}  // namespace irk
