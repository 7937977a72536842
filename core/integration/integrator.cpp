#include "irk/integrator.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include "core/base/constants.h"
#include "core/base/in_use.h"
#include "core/base/recycled.h"
#include "core/control/stall_detector.h"
#include "core/integration/backward.h"
#include "core/integration/memory_check.h"
#include "core/integration/rules.h"
#include "core/integration/step_sizes.h"
#include "core/integration/stop_rule.h"
#include "core/integration/trajectory.h"
#include "core/options/fixed_steps.h"
#include "core/system/counting.h"
#include "irk/multiprecision.h"
#include "irk/system_check.h"

namespace irk {
namespace {

template <class Real>
std::shared_ptr<const System<Real>> checked(std::shared_ptr<const System<Real>> system, const Vec<double>& scale) {
  requireSystem(system.get(), scale);
  return system;
}

/// Why a run ends before t_end; kSuccess: it goes on.
struct Stop {
  Outcome outcome = Outcome::kSuccess;
  double h = 0;
  std::string what = {};

  explicit operator bool() const { return outcome != Outcome::kSuccess; }
};

}  // namespace

template <class Real>
class Integrator<Real>::Run : public Recycled {
 public:
  Run(std::shared_ptr<const System<Real>> system, SchemeList<Real> schemes, std::size_t start,
      const IntegratorOptions& options, const Vec<double>& scale)
      : system_(checked(std::move(system), scale)),
        schemes_(std::move(schemes)),
        start_(start),
        options_(legalOptions(options, *system_, schemes_, start)),
        h_max_(options_.step.h_max),
        scale_(scale),
        stop_rule_(*system_, options_, scale),
        counted_(*system_, counters_, options_.threads),
        trajectory_(counted_, schemes_, start, options_, scale, counters_) {}

  Solution<Real> integrate(const State<Real>& start, const Real& t_end, const Monitor<Real>& monitor) {
    const InUse use(in_use_, "Integrator::integrate");
    if (liesBefore(t_end, start.t)) return integrateBackward(start, t_end, monitor);
    counters_ = {};
    monitor_ = follow(monitor);
    requireStart(*system_, start, t_end);
    const std::string not_finite = notFinite(start);
    if (!not_finite.empty()) return {Outcome::kNotFinite, "at the start: " + not_finite, start, counters_};
    requireNoMemory(*system_, start, t_end);
    length_ = static_cast<double>(Real(t_end - start.t));
    beginTimes(start.t, t_end);
    Outcome outcome = trajectory_.begin(start, length_, *monitor_);
    if (outcome == Outcome::kSuccess) outcome = passTimes(t_end);  // one may be next to the start
    if (outcome != Outcome::kSuccess) return trajectory_.failed(outcome, 0, "no step taken");
    const bool fixed = hasFixedSteps(options_.step);
    Stop stop = fixed ? fixedSteps(t_end) : adaptiveSteps(t_end);
    const std::string missed = stop ? std::string() : stop_rule_.missed();
    if (!missed.empty()) stop = {Outcome::kNoEvent, 0, missed};
    if (stop) return trajectory_.failed(stop.outcome, stop.h, stop.what);
    Solution<Real> solution = trajectory_.success();
    const std::string told = solution.outcome == Outcome::kSuccess ? stop_rule_.told() : "";
    if (!told.empty()) solution.detail = told + (solution.detail.empty() ? "" : "; ") + solution.detail;
    return solution;
  }

  void weighErrorsBy(const Vec<double>& scale) {
    const InUse use(in_use_, "Integrator::weighErrorsBy");
    const Index most = system_->sizes().components();
    if (scale.size() > most || !(scale.array() > 0).all() || !scale.allFinite()) {
      throw Misuse("Integrator::weighErrorsBy: the scale needs at most " + std::to_string(most) + " numbers, all > 0");
    }
    trajectory_.weighErrorsBy(scale);
    if (backward_) backward_->weighErrorsBy(scale);
    error_scale_ = scale;
  }

  void limitSteps(double h_max) {
    if (!(h_max > 0)) throw Misuse("Integrator::limitSteps: h_max needs a number > 0");
    h_max_ = std::min(h_max, options_.step.h_max);
    if (backward_) backward_->limitSteps(h_max);
  }

  const System<Real>& system() const { return *system_; }

 private:
  const State<Real>& state() const { return trajectory_.state(); }

  // The reversed system is integrated forward, in -t.
  Solution<Real> integrateBackward(const State<Real>& start, const Real& t_end, const Monitor<Real>& monitor) {
    requireState("start", start, system_->sceneSizes());
    if (!backward_) {
      backward_ = std::make_unique<Run>(reversedSystem(system_), schemes_, start_, options_, scale_);
      backward_->weighErrorsBy(error_scale_);
      backward_->limitSteps(h_max_);
    }
    requireNoJumps(*backward_->system_, start, t_end);
    Solution<Real> solution = backward_->integrate(reversed(start), opposite(t_end), reversed(monitor));
    solution.state = reversed(solution.state);
    return solution;
  }

  // The monitor of the integration that begins: the caller's, and with it the rule that may end it.
  const Monitor<Real>* follow(const Monitor<Real>& callers) {
    stop_rule_.begin();
    if (!stop_rule_.waitsForSwitch()) return &callers;
    following_ = callers;
    following_.switched = [this, told = callers.switched](const SwitchRecord<Real>& change) {
      stop_rule_.switched(change.index);
      if (told) told(change);
    };
    return &following_;
  }

  Stop fixedSteps(const Real& t_end) {
    const Grid<Real> grid(state().t, t_end, length_, options_.step.h);
    if (grid.count > static_cast<double>(options_.step.max_steps)) {
      return {Outcome::kMaxSteps, static_cast<double>(grid.h), "too many steps asked for"};
    }
    for (std::int64_t i = 0; i < grid.steps() && !stop_rule_.reached(); ++i) {
      Stop stop = fixedStep(grid.h, grid.end(i), grid.isWhole(i));
      if (stop) return stop;
    }
    return {};
  }

  // Goes to `end` by one step: of size h if `whole`, else of the length that is left. Times of the system and located
  // switches split the step.
  Stop fixedStep(const Real& h, const Real& end, bool whole) {
    while (state().t < end && !stop_rule_.reached()) {
      const Real stop_at = beforeTime(end);
      if (stop_at < end) whole = false;
      const Real step = whole ? h : Real(stop_at - state().t);
      const double size = static_cast<double>(step);
      Stop stop = askCaller(size);
      if (stop) return stop;
      const AttemptResult result = trajectory_.attempt(step);
      if (result.outcome != Outcome::kSuccess) return {result.outcome, size, "step not solved"};
      Outcome outcome = trajectory_.commit(result, step, stop_at);
      if (outcome == Outcome::kSuccess) {
        stop_rule_.stepped(state());
        outcome = passTimes(end);
      }
      if (outcome != Outcome::kSuccess) return {outcome, size, "the switch cannot be passed"};
      whole = false;
    }
    return {};
  }

  Stop adaptiveSteps(const Real& t_end) {
    if (length_ == 0) return {};
    double h = std::min(firstStep(), h_max_);
    stall_.begin(static_cast<double>(state().t));
    last_steps_.begin();
    too_small_ = Outcome::kStepTooSmall;
    for (std::int64_t attempts = 0; state().t < t_end && !stop_rule_.reached(); ++attempts) {
      if (Stop stop = askCaller(h)) return stop;
      if (Stop stop = cannotGoOn(attempts, h, t_end)) return stop;
      if (Stop stop = adaptiveStep(h, beforeTime(t_end))) return stop;
      const Outcome outcome = passTimes(t_end);
      if (outcome != Outcome::kSuccess) return {outcome, h, "the switch cannot be passed"};
    }
    return {};
  }

  // Collects the times of the system between the start and the end of the integration.
  void beginTimes(const Real& t0, const Real& t_end) {
    times_ = system_->times();
    next_time_ = 0;
    while (next_time_ < times_.size() && times_[next_time_] <= t0) ++next_time_;
    while (times_.size() > next_time_ && times_.back() >= t_end) times_.pop_back();
  }
  // `end`, or the next time of the system if it is earlier.
  Real beforeTime(const Real& end) const {
    return next_time_ < times_.size() && times_[next_time_] < end ? times_[next_time_] : end;
  }
  // Passes the times that are reached, before `end`.
  Outcome passTimes(const Real& end) {
    for (;;) {
      reach(beforeTime(end));
      if (next_time_ >= times_.size() || state().t < times_[next_time_]) return Outcome::kSuccess;
      const Outcome outcome = trajectory_.passTime(static_cast<Index>(next_time_++));
      if (outcome != Outcome::kSuccess) return outcome;
    }
  }

  // One attempt. `h` is its size; on return the size of the next attempt.
  Stop adaptiveStep(double& h, const Real& t_end) {
    const double least = smallestSize();
    const Real left = t_end - state().t;
    const Real step = last_steps_.size(h, left, t_end);
    const bool last = last_steps_.reachesEnd();
    const double size = static_cast<double>(step);
    const AttemptResult result = trajectory_.attempt(step);
    if (result.outcome != Outcome::kSuccess) {
      too_small_ = result.outcome == Outcome::kNewtonFailed ? Outcome::kStepTooSmall : result.outcome;
      h = trajectory_.shorten(size);
      // The rates after a restart may be much larger than those that the size has grown with. The smallest size is
      // tried before the run ends.
      if (trajectory_.isFirstStep()) h = std::min(h, std::max(sizeByRates(state()), least));
      return {};
    }
    const StepDecision decision = trajectory_.decide(result, size, resolvedSize());
    // A step that was cut short does not reduce the size of the next one.
    h = std::min(last_steps_.cut() && decision.accept ? std::max(h, decision.h) : decision.h, h_max_);
    if (!decision.accept) {
      ++counters_.steps_rejected_error;
      too_small_ = Outcome::kStepTooSmall;
      h = beforeSwitch(result, size, h, least);
      return {};
    }
    const Real before = state().t;
    const Outcome outcome = trajectory_.commit(result, step, last ? t_end : trajectory_.next().t);
    const bool undefined = outcome == Outcome::kNotFinite && state().t == before;  // where a switch was searched
    if (undefined || (isRecoverable(outcome) && !trajectory_.atSingularPosition())) {
      ++counters_.steps_rejected_newton;
      if (undefined) too_small_ = outcome;
      h = trajectory_.shorten(size);
      return {};
    }
    if (outcome != Outcome::kSuccess) return {outcome, size, "the switch cannot be passed"};
    stop_rule_.stepped(state());
    h = std::min(trajectory_.nextSize(result, size, h), h_max_);
    return {};
  }

  Stop askCaller(double h) const {
    if (!monitor_->interrupt) return {};
    return {monitor_->interrupt(), h, "stopped"};
  }

  // Why no attempt of size h is possible after `attempts` attempts; kSuccess if one is.
  Stop cannotGoOn(std::int64_t attempts, double h, const Real& t_end) {
    const std::int64_t left = options_.step.max_steps - attempts;
    if (left == 0) return {Outcome::kMaxSteps, h, "too many steps"};
    if (!(h > 0)) return {too_small_, h, "the step control chose no size > 0 " + trajectory_.rejections()};
    const bool undefined = too_small_ == Outcome::kNotFinite;
    const char* const what =
        undefined ? "the residual or a derivative is not finite in the smallest step as well " : "step too small ";
    if (h < smallestSize()) return {too_small_, h, what + trajectory_.rejections()};
    const bool stalls =
        attempts > 0 && stall_.attempted(static_cast<double>(state().t), static_cast<double>(t_end), left);
    if (stalls) return {Outcome::kStalled, h, "steps do not grow " + trajectory_.rejections()};
    return {};
  }

  double firstStep() const {
    if (options_.step.h > 0) return std::min(options_.step.h, length_);
    const double h = sizeByRates(state());
    return std::min(std::isfinite(h) ? h : 1e-4 * length_, kShrinkAtMost * length_);
  }

  // After a rejection with a switch in the step, the next step ends just before the switch. The step over the switch is
  // then so small that the mode may be wrong in it.
  static double beforeSwitch(const AttemptResult& result, double step, double h, double least) {
    const double before = kSafety * result.switch_at * step;
    return before > least ? before : h;
  }

  // Below 16 eps |t|, t + c_i h does not resolve the stages. Near t = 0 any size does; there |t| is taken to be eps
  // times the interval's length, the least time that the end of the interval still resolves. 16 eps times the length
  // would be too large: e5 begins with 6e-22 of its length (1e13, variable, 1e-12), the least of the IVP test set's
  // scenes.
  double resolvedSize() const {
    const double eps = static_cast<double>(Real(Eigen::NumTraits<Real>::epsilon()));
    return kSmallestStep * eps * std::max(std::abs(static_cast<double>(state().t)), eps * length_);
  }
  double smallestSize() const { return std::max(options_.step.h_min, resolvedSize()); }

  // After a switch or a time next to the end the rest is too short for a step.
  void reach(const Real& end) {
    if (state().t < end && static_cast<double>(Real(end - state().t)) < resolvedSize()) {
      trajectory_.endAt(end);
    }
  }

  std::atomic_flag in_use_;
  std::shared_ptr<const System<Real>> system_;
  SchemeList<Real> schemes_;
  std::size_t start_;
  IntegratorOptions options_;
  double h_max_;
  Vec<double> scale_, error_scale_;
  StopRule<Real> stop_rule_;
  Counters counters_;
  CountingSystem<Real> counted_;
  Trajectory<Real> trajectory_;
  StallDetector stall_;
  LastSteps<Real> last_steps_;
  const Monitor<Real>* monitor_ = nullptr;
  Monitor<Real> following_;
  double length_ = 0;
  std::vector<Real> times_;                     // of the system, those before the end
  std::size_t next_time_ = 0;                   // the first that is not yet reached
  Outcome too_small_ = Outcome::kStepTooSmall;  // the outcome of a step below the smallest size
  std::unique_ptr<Run> backward_;               // made for the first t_end before a start
};

template <class Real>
Integrator<Real>::Integrator(std::shared_ptr<const System<Real>> system, const Methods<Real>& methods,
                             const IntegratorOptions& options, const Vec<double>& scale)
    : run_(std::make_unique<Run>(std::move(system), SchemeList<Real>(methods), methods.start, options, scale)) {}
template <class Real>
Integrator<Real>::~Integrator() = default;
template <class Real>
Integrator<Real>::Integrator(Integrator&&) noexcept = default;

template <class Real>
Solution<Real> Integrator<Real>::integrate(const State<Real>& start, const Real& t_end, const Monitor<Real>& monitor) {
  if (!run_) throw Misuse("Integrator::integrate: the object has been moved from");
  return run_->integrate(start, t_end, monitor);
}

template <class Real>
void Integrator<Real>::weighErrorsBy(const Vec<double>& scale) {
  if (!run_) throw Misuse("Integrator::weighErrorsBy: the object has been moved from");
  run_->weighErrorsBy(scale);
}

template <class Real>
void Integrator<Real>::limitSteps(double h_max) {
  if (!run_) throw Misuse("Integrator::limitSteps: the object has been moved from");
  run_->limitSteps(h_max);
}

template <class Real>
const System<Real>& Integrator<Real>::system() const {
  if (!run_) throw Misuse("Integrator::system: the object has been moved from");
  return run_->system();
}

IRK_INSTANTIATE_CLASS(Integrator)

}  // namespace irk
