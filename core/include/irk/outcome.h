// How a numerical operation ended. Bad input is an exception (Misuse); numerical failures are these values.
#pragma once

#include <cstddef>
#include <iterator>
#include <string_view>

namespace irk {

/// One list for all levels, so that a cause has the same name from where it occurs to the row of the run. A
/// factorization ends with kSuccess, kSingular or kNotFinite. Newton's method and a step may also end with
/// kNewtonFailed, a step that switches with kChattering, a start with kInconsistentStart. The other values belong to a
/// whole run.
enum class Outcome {
  kSuccess,
  kNewtonFailed,       ///< no convergence, and the step may not be (or was already) reduced
  kStepTooSmall,       ///< the controller asked for a step below the minimum
  kMaxSteps,           ///< the limit of attempted steps is used up
  kTimeout,            ///< the caller's time limit is over
  kInterrupted,        ///< the caller interrupted the integration
  kNotFinite,          ///< the residual or its derivatives are NaN or infinite at the step's start
  kSingular,           ///< the Newton matrix is singular
  kInconsistentStart,  ///< constraints are violated, or accelerations cannot be determined
  kChattering,         ///< switches follow each other while no time passes
  kStalled,            ///< steps stay so small that the end is out of reach
  kDrift,              ///< the state at the end violates the position constraints, or a step those that are left out
  kNoEvent,            ///< the integration reached t_end before what it should end at (stop_at, steady)
  kInaccurate,         ///< the error bar of the result exceeds 1000 tolerances (irk/error_bar.h)
};

/// Whether a shorter step may succeed: Newton's method failed, or its matrix is singular.
constexpr bool isRecoverable(Outcome outcome) {
  return outcome == Outcome::kNewtonFailed || outcome == Outcome::kSingular;
}

/// In the order of Outcome.
inline constexpr std::string_view kOutcomeNames[] = {
    "success",  "newton_failed",      "step_too_small", "max_steps", "timeout", "interrupted", "not_finite",
    "singular", "inconsistent_start", "chattering",     "stalled",   "drift",   "no_event",    "inaccurate"};
static_assert(std::size(kOutcomeNames) == static_cast<std::size_t>(Outcome::kInaccurate) + 1);
/// The name in tables, CSV and JSON: `success`, `newton_failed`, ...
constexpr std::string_view name(Outcome outcome) { return kOutcomeNames[static_cast<std::size_t>(outcome)]; }

}  // namespace irk
