// How a numerical operation ended. Misuse is an exception; these are results.
#pragma once

#include <string_view>

namespace irk {

/// One list for all levels, so that a cause keeps its name from where it is found to the row of the run: a
/// factorization ends with kSuccess, kSingular or kNotFinite; Newton's method and a step also with kNewtonFailed, a
/// step that switches with kChattering, a start with kInconsistentStart; the other values belong to a whole run.
enum class Outcome {
  kSuccess,
  kNewtonFailed,       ///< no convergence, and the step may not be (or was already) reduced
  kStepTooSmall,       ///< the controller asked for a step below the minimum
  kMaxSteps,           ///< the limit of attempted steps is used up
  kTimeout,            ///< the caller's clock said stop
  kInterrupted,        ///< the caller said stop
  kNotFinite,          ///< the residual or its derivatives are NaN or infinite at the step's start
  kSingular,           ///< the Newton matrix is singular
  kInconsistentStart,  ///< constraints are violated, or accelerations cannot be determined
  kChattering,         ///< switches follow each other without time passing
  kStalled,            ///< steps stay so small that the end is out of reach
  kDrift,              ///< the end is reached, but it violates the position constraints
  kInaccurate,         ///< errors of all steps, or of undamped stiff components, are more than 200 tolerances
};

/// Whether a shorter step may end better: Newton's method failed, or its matrix is singular.
constexpr bool isRecoverable(Outcome outcome) {
  return outcome == Outcome::kNewtonFailed || outcome == Outcome::kSingular;
}

/// The name in tables: `success`, `newton_failed`, ...
constexpr std::string_view name(Outcome outcome) {
  switch (outcome) {
    case Outcome::kSuccess:
      return "success";
    case Outcome::kNewtonFailed:
      return "newton_failed";
    case Outcome::kStepTooSmall:
      return "step_too_small";
    case Outcome::kMaxSteps:
      return "max_steps";
    case Outcome::kTimeout:
      return "timeout";
    case Outcome::kInterrupted:
      return "interrupted";
    case Outcome::kNotFinite:
      return "not_finite";
    case Outcome::kSingular:
      return "singular";
    case Outcome::kInconsistentStart:
      return "inconsistent_start";
    case Outcome::kChattering:
      return "chattering";
    case Outcome::kStalled:
      return "stalled";
    case Outcome::kDrift:
      return "drift";
    case Outcome::kInaccurate:
      return "inaccurate";
  }
  return "?";
}

}  // namespace irk
