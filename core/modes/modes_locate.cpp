// `locate`: the mode is constant, and the first root of a switching function ends the step.
#include <algorithm>
#include <cstdint>
#include <optional>

#include "core/modes/event_location.h"
#include "core/options/fixed_steps.h"
#include "core/steps/modes.h"

namespace irk {
namespace {

// The accuracy of a switch's time: a part of the tolerance; with fixed steps round-off.
double locationTolerance(const IntegratorOptions& options) {
  if (hasFixedSteps(options.step)) return 0;
  return std::max(options.tolerances.rtol, options.tolerances.atol);
}

/// Shortens a step to the first switch in it.
template <class Real>
class LocatedAfterStep final : public ModesAfterStep<Real> {
 public:
  LocatedAfterStep(const System<Real>& system, const IntegratorOptions& options) : looks_(options.step.looks) {
    if (system.sizes().switches > 0) locator_.emplace(system, locationTolerance(options));
  }

  void begin(double t, double length) override {
    if (locator_) locator_->begin(t, length, looks_);
  }

  CommittedStep<Real> accept(StepAttempt<Real>& attempt, const AttemptResult& solved, const State<Real>& from,
                             const Real& h, State<Real>& next) override {
    if (!locator_) return {Outcome::kSuccess, solved, h};
    const Location<Real> at = locator_->locate(attempt, from, h, next);
    CommittedStep<Real> step{at.outcome, solved, h};
    step.index = at.index;
    if (at.outcome != Outcome::kSuccess) return step;
    step.shortened = at.h < h;
    if (step.shortened) {
      step.attempt = at.attempt;
      step.h = at.h;
      // Its error exceeds the tolerance (NaN: fixed steps). kNewtonFailed is recoverable: a shorter step is tried.
      if (at.attempt.error > 1) {
        step.outcome = Outcome::kNewtonFailed;
        step.index = -1;
      }
    }
    if (at.found && step.outcome == Outcome::kSuccess) locator_->switched(at.index, from.t + at.h);
    step.at_switch = at.found;
    step.resolution = at.resolution;
    step.time_error = at.time_error;
    return step;
  }

 private:
  std::int64_t looks_;
  std::optional<EventLocator<Real>> locator_;  // none if there are no switches to look for
};

/// Nothing to do after a solved step: its mode is right up to the switch that ends it.
template <class Real>
std::unique_ptr<ModesInStep<Real>> nothing(const System<Real>&, const IntegratorOptions&, const ErrorNorm<Real>&,
                                           Counters&) {
  return nullptr;
}

}  // namespace

Strategy<Discontinuity> locatedModes() {
  return {Discontinuity::kLocate,
          "the root of a switching function ends the step; restart",
          {},
          {nothing<double>, nothing<BigFloat>},
          makes<ModesAfterStepMaker, LocatedAfterStep>()};
}

}  // namespace irk
