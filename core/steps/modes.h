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
  /// Solves the step again from `start`: the step's start with another mode, which must outlive the step. Adds the
  /// iterations to `result` and sets the outcome. The stages and the step's end become those of this solve.
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

/// What a treatment does after a solved step. Owns scratch.
template <class Real>
class ModesInStep {
 public:
  virtual ~ModesInStep() = default;
  /// Updates the mode at the end of the step and judges the step: sets `switched`, `switch_at` and `mode_error` of the
  /// result. If no mode is valid, sets an outcome other than kSuccess.
  virtual void settle(SolvedStep<Real>& step, StepResult& result) = 0;
};

/// A step with an accepted error, as the treatment of switches leaves it.
template <class Real>
struct CommittedStep {
  /// Other than kSuccess: the step cannot be taken over; if isRecoverable, a shorter one may be.
  Outcome outcome = Outcome::kSuccess;
  AttemptResult attempt;  ///< result of the step that is taken over
  Real h{};               ///< its size
  bool shortened = false;
  bool switched = false;   ///< the mode changed in the step; the step's end has the new mode
  bool at_switch = false;  ///< a switch is due at its end
  Index index = -1;        ///< of the switch, or of the switch that caused the failure
  double resolution = 0;   ///< to which the time of the switch can be known
  double time_error = 0;   ///< of the switch
};

/// What a treatment does after acceptance. The defaults suit treatments whose steps go on over switches.
template <class Real>
class ModesAfterStep {
 public:
  virtual ~ModesAfterStep() = default;
  /// Called at the start t of an integration over an interval of this length.
  virtual void begin(double t, double length) {
    static_cast<void>(t);
    static_cast<void>(length);
  }
  /// Whether switches that are due at the start are carried out there.
  virtual bool settlesAtStart() const { return true; }
  /// Whether an integration starts anew after a step in which the mode changed.
  virtual bool restarts() const { return false; }
  /// Treats the accepted step of size h from `from` to `next`, the last one that `attempt` has solved.
  virtual CommittedStep<Real> accept(StepAttempt<Real>& attempt, const AttemptResult& solved, const State<Real>& from,
                                     const Real& h, State<Real>& next) {
    static_cast<void>(attempt);
    CommittedStep<Real> step{Outcome::kSuccess, solved, h};
    step.switched = next.d != from.d;
    return step;
  }
};

/// Null: the treatment does nothing after a solved step.
template <class Real>
using ModesInStepMaker = std::function<std::unique_ptr<ModesInStep<Real>>(const System<Real>&, const IntegratorOptions&,
                                                                          const ErrorNorm<Real>&, Counters&)>;
template <class Real>
using ModesAfterStepMaker =
    std::function<std::unique_ptr<ModesAfterStep<Real>>(const System<Real>&, const IntegratorOptions&)>;

/// A strategy of the axis `discontinuity`: a treatment of switches.
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
