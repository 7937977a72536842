// The result of an attempted step.
#pragma once

#include <limits>

#include "irk/outcome.h"
#include "irk/scalar.h"

namespace irk {

struct StepResult {
  Outcome outcome = Outcome::kSuccess;
  int newton_iterations = 0;
  double theta = 0;      ///< Newton's contraction (see NewtonResult), the worst of the attempt's solves
  double round_off = 0;  ///< of Newton's increments, in tolerances (see NewtonResult)
  Index switched = -1;   ///< the last switch at the step's end, or the switch that caused a failure
  /// The part of the step at which the switch became due, by linear interpolation, in (0, 1]; NaN without a switch.
  double switch_at = std::numeric_limits<double>::quiet_NaN();
  /// The effect of the wrong mode over a step in which a switch becomes due, in the error norm. `iterate`: the
  /// difference between the step in its first mode and in its last; if the switch comes and goes inside the step, h
  /// times the change of (a, k) that it causes. `ignore` and `smooth`, with an estimate that looks at switches: h times
  /// the largest change of (a, k) in the step.
  double mode_error = 0;
};

/// The result of an attempted step with its error estimate.
struct AttemptResult : StepResult {
  /// Estimate in the error norm, accepted up to 1 (but see too_strict); NaN without one. With variable order it is
  /// multiplied by the member's strictness (core/control/order_controller.h).
  double error = 0;
  /// Whether that strictness alone rejects the step. One of about the size that time resolves is accepted all the same.
  bool too_strict = false;
};

}  // namespace irk
