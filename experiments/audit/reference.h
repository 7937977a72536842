// The references of the audit: the state at t_end, found independently of the judged run, and its sensitivity.
#pragma once

#include <atomic>
#include <compare>
#include <limits>
#include <string>

#include "experiments/runs/run.h"
#include "experiments/study/draw.h"

namespace irk::audit {

/// Runs with equal questions share one answer.
struct Question {
  std::string scene, settings;  ///< settings as `settingsText`
  double t_end = 0;
  bool smooth = false;  ///< the regularized problem, which has another solution

  auto operator<=>(const Question&) const = default;
};
Question questionOf(const RunSpec& spec);

/// States are u, v, x, z of the scene, one after the other; NaN if unknown; empty if there is none.
struct Answer {
  Vec<double> state;
  /// The state that the other family's method found; empty unless computed. It judges runs of the first method's
  /// family.
  Vec<double> other;
  std::string source;  ///< `exact`, `file`, `computed`, or empty: none
  /// The accuracy of the state, measured as an error. NaN without a state.
  double accuracy = std::numeric_limits<double>::quiet_NaN();
  double kappa = accuracy;  ///< see judge.h; NaN if it is not known: the strict run fails, no closed form tells
  std::string remark;       ///< why there is no answer, or why it is doubtful
  double cpu_s = 0;

  const Vec<double>& stateFor(const std::string& family) const;
};

/// The exact state, with the growth of errors of its closed form and without any run, infinite where there is no
/// solution; or the state of the reference files, if these know all of u, v, x at t_end. Otherwise the state
/// on which two strict runs of different families agree (Radau IIA and Lobatto IIIC of variable order; index 2,
/// switches located, small steps). If the scene switches, a third run that leaves the switches to its error estimate
/// must follow the same history. All options are given explicitly, so that changed defaults change no answer. If double
/// precision does not suffice, two runs in 50 digits decide for small systems without switches. Unless the state is
/// exact, the perturbed starts are integrated, too. After an interrupt the answer has the source `interrupted`.
Answer answerOf(const Question& question, const std::atomic<bool>* stop);

inline constexpr const char* kInterruptedSource = "interrupted";

}  // namespace irk::audit
