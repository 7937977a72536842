// Callbacks of an integration, and its result.
#pragma once

#include <functional>
#include <string>

#include "irk/outcome.h"
#include "irk/statistics.h"
#include "irk/system.h"

namespace irk {

/// The solution inside an accepted step (dense output): the polynomial through the stages, integrated from the step's
/// start. Its order is that of the stages, not that of the step's end: for a collocation method with s stages about
/// s + 1 (u one more, a, k and z one less), for other methods at most their stage order plus 2, and in no case more
/// than the method's order. At tight tolerances it is less accurate than the ends of the steps.
template <class Real>
class InsideStep {
 public:
  /// The state at t, in the scene's unknowns; a t outside the step stands for the nearer end. At the ends of the step
  /// these are the states of the steps, at its start with the discrete state of the step.
  virtual State<Real> at(const Real& t) = 0;

 protected:
  ~InsideStep() = default;
};

/// One accepted step. `state`, in the scene's unknowns (u, v, x, z), is valid during the callback only.
template <class Real>
struct StepRecord {
  Real t;  ///< at the end of the step
  double h;
  double error;           ///< error estimate in the error norm; NaN without an estimate
  int newton_iterations;  ///< of the whole attempt, all its solves together
  const State<Real>& state;
  /// Valid during the callback only. Null: not asked for (Monitor::inside), or not known, as of integrators of other
  /// libraries and of methods that have a stage time twice.
  InsideStep<Real>* inside = nullptr;
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
  bool inside = false;  ///< whether `accepted` asks for StepRecord::inside; without it nothing is kept for that
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
