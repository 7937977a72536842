// `ignore` and `smooth`: the mode follows the solution from step to step.
#include <algorithm>
#include <memory>

#include "core/estimates/step_attempt.h"
#include "core/modes/switch_effect.h"
#include "core/steps/modes.h"

namespace irk {
namespace {

/// Judges a step over a switch. The estimate by doubling is wrong there: both solutions have the same wrong mode before
/// their first stage, behind their last one, and between two stages. The effect of the switch over the whole step
/// bounds the error.
template <class Real>
class FollowedModes : public ModesInStep<Real> {
 public:
  FollowedModes(const System<Real>& system, const IntegratorOptions& options, const ErrorNorm<Real>& norm,
                Counters& counters)
      : switches_(system),
        effect_(system, options, norm, counters),
        before_(system.sizes()),
        looks_further_(catalogue<ErrorEstimate>()[options.step.estimate].looks_further) {}

 protected:
  /// Carries out the switches that are due at the step's end; `before_` is the end before them.
  SwitchReport update(SolvedStep<Real>& step, Jumps jumps, StepResult& result) {
    before_ = step.to;
    switches_.begin();
    const SwitchReport report = switches_.settle(step.to, jumps);
    if (report.index >= 0) result.switched = report.index;
    return report;
  }
  void judge(const SolvedStep<Real>& step, const SwitchReport& report, StepResult& result) {
    if (!looks_further_) return;
    Index inside = -1;
    if (report.count == 0 && !effect_.dueInside(step, before_, inside)) return;
    if (inside >= 0) {
      result.switched = inside;
      result.mode_error = effect_.changeOfRates(step.h);  // there: no stage need have this mode, nor the step's end
    }
    result.mode_error = std::max(result.mode_error, effect_.changeInStep(step, before_));
  }

 private:
  Switches<Real> switches_;
  SwitchEffect<Real> effect_;
  State<Real> before_;
  bool looks_further_;
};

/// The mode at the end of a step is the mode of the next step.
template <class Real>
class IgnoredInStep final : public FollowedModes<Real> {
 public:
  using FollowedModes<Real>::FollowedModes;
  void settle(SolvedStep<Real>& step, StepResult& result) override {
    const SwitchReport report = this->update(step, Jumps::kDone, result);
    result.outcome = report.outcome;
    if (result.outcome == Outcome::kSuccess) this->judge(step, report, result);
  }
};

/// Residuals use the regularisation; the mode is only a hint.
template <class Real>
class SmoothInStep final : public FollowedModes<Real> {
 public:
  using FollowedModes<Real>::FollowedModes;
  void settle(SolvedStep<Real>& step, StepResult& result) override {
    this->judge(step, this->update(step, Jumps::kNone, result), result);
  }
};

/// Nothing switches.
template <class Real>
class SmoothAfterStep final : public ModesAfterStep<Real> {
 public:
  SmoothAfterStep(const System<Real>&, const IntegratorOptions&) {}
  bool settlesAtStart() const override { return false; }
  CommittedStep<Real> accept(StepAttempt<Real>&, const AttemptResult& solved, const State<Real>&, const Real& h,
                             State<Real>&) override {
    return {Outcome::kSuccess, solved, h};
  }
};

}  // namespace

Strategy<Discontinuity> ignoredModes() {
  return {Discontinuity::kIgnore,
          "jumps are left to the error estimate (paper)",
          {},
          makes<ModesInStepMaker, IgnoredInStep>(),
          {[](const auto&...) { return std::make_unique<ModesAfterStep<double>>(); },
           [](const auto&...) { return std::make_unique<ModesAfterStep<BigFloat>>(); }}};
}

Strategy<Discontinuity> smoothModes() {
  return {Discontinuity::kSmooth,
          "the scene's regularisation",
          {},
          makes<ModesInStepMaker, SmoothInStep>(),
          makes<ModesAfterStepMaker, SmoothAfterStep>()};
}

}  // namespace irk
