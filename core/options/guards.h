// The guards of a step, as an option chooses them.
#pragma once

#include "irk/options.h"

namespace irk {

/// What is checked of a solved step besides its error estimate.
enum class Guard {
  kDefect,        ///< core/estimates/defect.h
  kSmoothness,    ///< Stepper::roughness of a step and its halves
  kRestart,       ///< Stepper::startDefect
  kSwitchEffect,  ///< core/modes/switch_effect.h
};

/// Whether the set has the guard.
constexpr bool has(Guards set, Guard guard) {
  switch (set) {
    case Guards::kAll:
      return true;
    case Guards::kNone:
      return false;
    case Guards::kWithoutDefect:
      return guard != Guard::kDefect;
    case Guards::kWithoutSmoothness:
      return guard != Guard::kSmoothness;
    case Guards::kWithoutRestart:
      return guard != Guard::kRestart;
    case Guards::kWithoutSwitchEffect:
      return guard != Guard::kSwitchEffect;
  }
  return true;
}

}  // namespace irk
