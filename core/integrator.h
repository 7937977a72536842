// From a start to an end: accepted steps, their record, and how it ended.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "core/options.h"
#include "core/outcome.h"
#include "core/statistics.h"
#include "core/system.h"
#include "core/tableau.h"

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

/// One integration at a time; reusable. Allocates in its constructor, not in its steps. One per
/// thread; the system and the tableau are shared.
template <class Real>
class Integrator {
 public:
  /// `scale`: typical magnitudes of u, v, x, z (2 nu + nx + nz); empty = 1.
  /// Throws Misuse for a system that cannot be (core/system_check.h) and for illegal combinations, naming both ids and the reason: several methods but
  /// with variable order and the estimate `embedded`, a family that cannot treat algebraic unknowns, `eigen` with a defective A, `full` with a decoupled solver, ...
  Integrator(std::shared_ptr<const System<Real>> system, const Methods<Real>& methods,
             const IntegratorOptions& options, const Vec<double>& scale = {});
  ~Integrator();
  Integrator(Integrator&&) noexcept;

  /// From `start` (the scene's u, v, x, z) to t_end. Returns every numerical failure as an outcome, kNotFinite for a
  /// start with a NaN. Throws Misuse for a start of other sizes than the scene's, and for times that are not finite or
  /// in the wrong order.
  [[nodiscard]] Solution<Real> integrate(const State<Real>& start, const Real& t_end,
                                         const Monitor<Real>& monitor = {});

 private:
  class Run;
  std::unique_ptr<Run> run_;
};

}  // namespace irk
