// What a caller hears of an integration while it runs, and what it gets at the end.
#pragma once

#include <functional>
#include <string>

#include "irk/outcome.h"
#include "irk/statistics.h"
#include "irk/system.h"

namespace irk {

/// One accepted step, as an observer sees it. `state` is in the scene's unknowns (u, v, x, z).
template <class Real>
struct StepRecord {
  Real t;                       ///< at the end of the step
  double h;
  double error;                 ///< estimate in the error norm, NaN without one
  int newton_iterations;        ///< of the whole attempt
  const State<Real>& state;
};

/// One switch. `state`: just after it, in the scene's unknowns.
template <class Real>
struct SwitchRecord {
  Real t;
  Index index;  ///< of the switching function
  std::string name;
  const State<Real>& state;
};

/// What the caller wants to know and to say while an integration runs. All optional.
template <class Real>
struct Monitor {
  std::function<void(const StepRecord<Real>&)> accepted;
  std::function<void(const SwitchRecord<Real>&)> switched;
  /// Asked before each step: kSuccess goes on; kTimeout or kInterrupted ends the run.
  std::function<Outcome()> interrupt;
};

template <class Real>
struct Solution {
  Outcome outcome = Outcome::kSuccess;
  std::string detail;  ///< where and what, in one line: of a failure, or what a success has to tell
  /// The last accepted state, in the scene's unknowns. (a, k, z) at t_end as the option `multipliers`
  /// says; those of the step records are always the stages'.
  State<Real> state;
  Counters counters;
};

}  // namespace irk
