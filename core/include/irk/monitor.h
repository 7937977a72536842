// Callbacks of an integration, and its result.
#pragma once

#include <functional>
#include <string>

#include "irk/outcome.h"
#include "irk/statistics.h"
#include "irk/system.h"

namespace irk {

/// One accepted step. `state`, in the scene's unknowns (u, v, x, z), is valid during the callback only.
template <class Real>
struct StepRecord {
  Real t;  ///< at the end of the step
  double h;
  double error;           ///< error estimate in the error norm; NaN without an estimate
  int newton_iterations;  ///< of the whole attempt, all its solves together
  const State<Real>& state;
};

/// One switch. `state`: just after the switch, in the scene's unknowns; valid during the callback only.
template <class Real>
struct SwitchRecord {
  Real t;
  Index index;  ///< of the switching function
  std::string name;
  const State<Real>& state;
};

/// Callbacks; each may be empty. They are called from within Integrator::integrate, on the caller's thread.
template <class Real>
struct Monitor {
  std::function<void(const StepRecord<Real>&)> accepted;
  std::function<void(const SwitchRecord<Real>&)> switched;
  /// Called before each step. kSuccess continues; kTimeout or kInterrupted ends the integration with that outcome.
  std::function<Outcome()> interrupt;
};

/// The result of an integration.
template <class Real>
struct Solution {
  Outcome outcome = Outcome::kSuccess;
  std::string detail;  ///< one line: where and why an integration failed, or a remark on a success; may be empty
  /// The last accepted state, in the scene's unknowns; its t tells how far the integration came. At t_end
  /// (a, k, z) are computed as the option `multipliers` says; in step records they always come from the stages.
  State<Real> state;
  Counters counters;
};

}  // namespace irk
