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
  /// The state at t, in the scene's unknowns. A t outside the step counts as the nearer end. At the ends of the step
  /// the result is the state of the integration there; at the start it has the discrete state of the step.
  virtual State<Real> at(const Real& t) = 0;

 protected:
  ~InsideStep() = default;
};

/// One accepted step. `state`, in the scene's unknowns (u, v, x, z), is valid during the callback only.
template <class Real>
struct StepRecord {
  Real t;  ///< at the end of the step
  double h;
  double error;           ///< error estimate in the error norm (1 = tolerance); NaN without an estimate
  int newton_iterations;  ///< of all solves of the attempt together
  const State<Real>& state;
  /// The solution inside the step, valid during the callback only. Null if Monitor::inside is false, and if it is not
  /// known: for integrators of other libraries, and for methods with two stages at one time.
  InsideStep<Real>* inside = nullptr;
  /// The estimated errors of u, v and x, up to their signs, valid during the callback only; in a step that ends at a
  /// located switch those of the step before it was shortened. Null with other estimates than `embedded`, and in
  /// formulations that have other unknowns than the scene.
  const State<Real>* errors = nullptr;
};

/// One switch. `state`: just after the switch, in the scene's unknowns; valid during the callback only.
template <class Real>
struct SwitchRecord {
  Real t;
  Index index;       ///< of the switching function; -1 where a step itself has asked for the switch
  std::string name;  ///< of the switching function; "step" where a step has asked
  const State<Real>& state;
};

/// One switch that was located, as it is passed. States are in the scene's unknowns and valid during the callback only.
template <class Real>
struct LocatedSwitch {
  double time_error;           ///< by the round-off of its function and the tolerance of its location
  const State<Real>& earlier;  ///< u, v, x behind it, had it been passed earlier by time_error
  const State<Real>& behind;   ///< u, v, x, and (a, k, z), behind it
};

/// Callbacks; each may be empty. They are called from within Integrator::integrate, on the caller's thread.
template <class Real>
struct Monitor {
  std::function<void(const StepRecord<Real>&)> accepted;
  bool inside = false;  ///< whether `accepted` needs StepRecord::inside; if not, the integration does not keep it
  std::function<void(const SwitchRecord<Real>&)> switched;
  std::function<void(const LocatedSwitch<Real>&)> located;
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
