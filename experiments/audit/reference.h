// What the audit judges against: the state at t_end that the judged run did not see, and how sensitive it is.
#pragma once

#include <atomic>
#include <compare>
#include <limits>
#include <string>

#include "experiments/runs/run.h"
#include "experiments/study/draw.h"

namespace irk::audit {

/// The runs of one question share one answer.
struct Question {
  std::string scene, settings;  ///< settings as `settingsText`
  double t_end = 0;
  bool smooth = false;  ///< the regularised problem, which is another one

  auto operator<=>(const Question&) const = default;
};
Question questionOf(const RunSpec& spec);

/// States are u, v, x, z of the scene, one after the other; NaN where unknown; empty without any.
struct Answer {
  Vec<double> state;
  /// Of a computed answer: what the method of the other family found. A run of the first method's
  /// family is judged by it.
  Vec<double> other;
  std::string source;  ///< `exact`, `file`, `computed`, or empty: none
  /// How well it is known, measured as an error. NaN without a state.
  double accuracy = std::numeric_limits<double>::quiet_NaN();
  double kappa = accuracy;  ///< see judge.h; NaN where even the strict run fails
  std::string remark;       ///< why there is no answer, or what contradicts it
  double cpu_s = 0;

  const Vec<double>& stateFor(const std::string& family) const;
};

/// Exact or from the references' files where these know all of u, v, x at t_end; else computed: two
/// strict runs of different families (radau_iia_7, lobatto_iiic_6; index 2, switches located, small
/// steps) that agree. Where the scene switches, a third one that leaves the switches to its error
/// estimate must have the same history. Every option is spelled out: a change of defaults changes no
/// answer. Also integrates the perturbed starts. Interrupted: an answer with the source `interrupted`.
Answer answerOf(const Question& question, const std::atomic<bool>* stop);

inline constexpr const char* kInterruptedSource = "interrupted";

}  // namespace irk::audit
