// `iterate`: the mode is constant in a step, and the step is solved again until its mode stays the same.
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/constants.h"
#include "core/estimates/step_attempt.h"
#include "core/modes/switch_effect.h"
#include "core/steps/modes.h"

namespace irk {
namespace {

/// HOTINT's discontinuous iteration: the mode is constant over the step and updated at its end; the step is solved
/// again with the new mode until the mode stays the same.
template <class Real>
class IteratedInStep final : public ModesInStep<Real> {
 public:
  IteratedInStep(const System<Real>& system, const IntegratorOptions& options, const ErrorNorm<Real>& norm,
                 Counters& counters)
      : system_(system),
        counters_(counters),
        switches_(system),
        effect_(system, options, norm, counters),
        frozen_(system.sizes()),
        first_mode_(system.sizes()),
        g_before_(system.sizes().switches) {}

  void settle(SolvedStep<Real>& step, StepResult& result) override {
    result.switch_at = firstDue(step);
    first_mode_ = step.to;
    if (!iterate(step, result)) return;
    if (done_.empty()) return judgeInside(step, result);
    // Multipliers jump with the mode; u, v, x do not.
    first_mode_.w = step.to.w;
    result.mode_error = effect_.difference(first_mode_, step.to, step.h);
    for (const Index k : done_) system_.jump(k, step.to);
  }

 private:
  // Returns false if no mode stays the same. `done_`: the switches carried out.
  bool iterate(SolvedStep<Real>& step, StepResult& result) {
    switches_.begin();
    done_.clear();
    for (int i = 0;; ++i) {
      const std::size_t before = done_.size();
      const SwitchReport report = switches_.settle(step.to, Jumps::kDone, [this](Index k) { done_.push_back(k); });
      if (report.index >= 0) result.switched = report.index;
      result.outcome = report.outcome;
      if (report.outcome != Outcome::kSuccess) return false;
      if (done_.size() == before) return true;
      if (i == kSwitchRounds.whole()) {
        result.outcome = Outcome::kChattering;
        return false;
      }
      ++counters_.discontinuous_iterations;
      frozen_ = step.from;
      frozen_.d = step.to.d;
      step.repeater.repeat(frozen_, result);
      if (result.outcome != Outcome::kSuccess) return false;
    }
  }
  // Judges a switch that comes and goes inside the step.
  void judgeInside(const SolvedStep<Real>& step, StepResult& result) {
    Index inside = -1;
    if (!effect_.dueInside(step, step.to, inside)) return;
    result.switched = inside;
    const SwitchReport report = switches_.settle(effect_.inside(), Jumps::kNone);
    result.mode_error =
        report.outcome == Outcome::kSuccess ? effect_.changeOfRates(step.h) : std::numeric_limits<double>::infinity();
  }
  // The time, as a part of the step, at which the first switching function becomes due, by a secant.
  double firstDue(const SolvedStep<Real>& step) {
    double first = std::numeric_limits<double>::quiet_NaN();
    if (switches_.evaluate(step.from).outcome != Outcome::kSuccess) return first;
    g_before_ = switches_.g();
    if (switches_.evaluate(step.to).outcome != Outcome::kSuccess) return first;
    for (Index i = 0; i < g_before_.size(); ++i) {
      const double before = static_cast<double>(g_before_[i]);
      const double after = static_cast<double>(switches_.g()[i]);
      if (after > 0 && before < 0) first = std::fmin(first, -before / (after - before));
    }
    return first;
  }

  const System<Real>& system_;
  Counters& counters_;
  Switches<Real> switches_;
  SwitchEffect<Real> effect_;
  State<Real> frozen_;      // the start with another mode
  State<Real> first_mode_;  // the step's end in the first mode
  Vec<Real> g_before_;
  std::vector<Index> done_;
};

template <class Real>
class IteratedAfterStep final : public ModesAfterStep<Real> {
 public:
  IteratedAfterStep(const System<Real>&, const IntegratorOptions&) {}
  bool restarts() const override { return true; }
};

}  // namespace

Strategy<Discontinuity> iteratedModes() {
  return {Discontinuity::kIterate,
          "modes frozen in Newton, updated after it, step repeated",
          {},
          makes<ModesInStepMaker, IteratedInStep>(),
          makes<ModesAfterStepMaker, IteratedAfterStep>()};
}

}  // namespace irk
