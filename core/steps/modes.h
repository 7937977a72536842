// How switches of the mode are treated: the strategies of the axis `discontinuity`.
//
// A treatment decides at three moments:
//   which mode the residual sees       Discontinuity::sees, core/include/irk/system.h
//   what follows a solved step         ModesInStep, one per stepper
//   what follows the step's acceptance ModesAfterStep, one per integration
#pragma once

#include <functional>
#include <memory>

#include "core/options/catalogue.h"
#include "core/stages/error_norm.h"
#include "core/stages/stage_equations.h"
#include "core/stages/start_values.h"
#include "core/steps/step_result.h"
#include "irk/statistics.h"

namespace irk {

template <class Real>
class StepAttempt;

/// Solves a step again.
template <class Real>
class StepRepeater {
 public:
  /// From `start`, the step's start with another mode; it must outlive the step. Adds its iterations to `result` and
  /// sets the outcome; the stages and the step's end become those of this solve.
  virtual void repeat(const State<Real>& start, StepResult& result) = 0;

 protected:
  ~StepRepeater() = default;
};

/// A step that Newton's method has solved.
template <class Real>
struct SolvedStep {
  const State<Real>& from;
  const Real& h;
  State<Real>& to;
  const StageEquations<Real>& eq;  ///< of the last solve
  const StagePolynomial<Real>& stages;
  StepRepeater<Real>& repeater;
};

/// What follows a solved step. Owns scratch.
template <class Real>
class ModesInStep {
 public:
  virtual ~ModesInStep() = default;
  /// Brings the mode at the end of the step up to date and judges the step: sets `switched`, `switch_at` and
  /// `mode_error` of the result, and an outcome that is no success where no mode is valid.
  virtual void settle(SolvedStep<Real>& step, StepResult& result) = 0;
};

/// A solved step whose error is accepted, as the treatment of switches leaves it.
template <class Real>
struct CommittedStep {
  /// No success: the step cannot be taken over. isRecoverable: a shorter one may be.
  Outcome outcome = Outcome::kSuccess;
  AttemptResult attempt;  ///< of the step that is taken over
  Real h{};               ///< its size
  bool shortened = false;
  bool switched = false;   ///< the mode changed in it: that of its end is the new one
  bool at_switch = false;  ///< a switch is due at its end
  Index index = -1;        ///< of the switch, also of one to blame
  double resolution = 0;   ///< how finely the time of the switch was looked for
};

/// What follows acceptance. The defaults are those of treatments whose steps go on over switches.
template <class Real>
class ModesAfterStep {
 public:
  virtual ~ModesAfterStep() = default;
  /// Whether switches that are due at a start are done there.
  virtual bool settlesAtStart() const { return true; }
  /// Whether an integration starts anew after a step in which the mode changed.
  virtual bool restarts() const { return false; }
  /// Of the step of size h from `from` to `next` that `attempt` has solved last.
  virtual CommittedStep<Real> accept(StepAttempt<Real>& attempt, const AttemptResult& solved, const State<Real>& from,
                                     const Real& h, State<Real>& next) {
    static_cast<void>(attempt);
    CommittedStep<Real> step{Outcome::kSuccess, solved, h};
    step.switched = next.d != from.d;
    return step;
  }
};

/// Null: nothing follows a solved step.
template <class Real>
using ModesInStepMaker = std::function<std::unique_ptr<ModesInStep<Real>>(const System<Real>&, const IntegratorOptions&,
                                                                          const ErrorNorm<Real>&, Counters&)>;
template <class Real>
using ModesAfterStepMaker =
    std::function<std::unique_ptr<ModesAfterStep<Real>>(const System<Real>&, const IntegratorOptions&)>;

/// A treatment of switches.
template <>
struct Strategy<Discontinuity> {
  Discontinuity id;
  std::string meaning;
  Needs needs;
  PerScalar<ModesInStepMaker> in_step;
  PerScalar<ModesAfterStepMaker> after_step;
};
template <>
Catalogue<Discontinuity>& catalogue<Discontinuity>();

}  // namespace irk
