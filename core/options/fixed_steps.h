// Fixed steps: all steps of an integration have one size.
#pragma once

#include "irk/options.h"

namespace irk {

/// Whether all steps have the size StepOptions::h. Such an integration has no controller, tolerance or error estimate.
constexpr bool hasFixedSteps(const StepOptions& options) { return options.control == StepControl::kFixed; }

}  // namespace irk
