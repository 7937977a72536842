#include "core/integrator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "core/consistent_start.h"
#include "core/controller.h"
#include "core/counting.h"
#include "core/event_location.h"
#include "core/multiprecision.h"

namespace irk {
namespace {

// Without a tolerance Newton iterates to round-off, in units of the solution's magnitude.
IntegratorOptions validated(IntegratorOptions options) {
  validate(options);
  if (options.step.control == StepControl::kFixed) {
    options.step.estimate = ErrorEstimate::kNone;
    options.tolerances = {1, 1, NormKind::kMixed};
    options.newton.kappa = std::numeric_limits<double>::min();
  }
  return options;
}

template <class Real>
void refuseIllegal(const Scheme<Real>& scheme, const System<Real>& system,
                   const IntegratorOptions& options) {
  const Sizes n = system.sizes();
  if (n.nz > 0 && !scheme.allowsAlgebraic()) {
    throw Misuse("illegal combination: method '" + scheme.tableau.id + "' with a system of " +
                 std::to_string(n.nz) + " algebraic unknowns: A is singular, the stages do not "
                 "determine them");
  }
  if (options.jacobian_point == JacobianPoint::kEachStage &&
      options.solver != StageSolverKind::kCoupledDense) {
    throw Misuse("illegal combination: jacobian_point 'each_stage' with solver '" +
                 std::string(idOf(options.solver)) +
                 "': stage-wise derivatives do not decouple; use solver 'coupled_dense'");
  }
  if (options.jacobian != JacobianTerms::kFull && !system.secondOrder()) {
    throw Misuse("illegal combination: jacobian '" + std::string(idOf(options.jacobian)) +
                 "' with formulation 'ggl': its accelerations are no unknowns of their own");
  }
  if (options.newton.kind == NewtonKind::kFull &&
      options.solver != StageSolverKind::kCoupledDense) {
    throw Misuse("illegal combination: newton 'full' with solver '" +
                 std::string(idOf(options.solver)) +
                 "': stage-wise derivatives do not decouple; use solver 'coupled_dense'");
  }
}

}  // namespace

template <class Real>
class Integrator<Real>::Run {
 public:
  Run(std::shared_ptr<const System<Real>> system, const Tableau<Real>& tableau,
      const IntegratorOptions& options, const Vec<double>& scale)
      : system_(std::move(system)),
        options_(validated(options)),
        counted_(*system_, counters_),
        scheme_(tableau),
        norm_(counted_, options_.tolerances, scale),
        switches_(counted_),
        locator_(counted_, scheme_, std::max(options_.tolerances.rtol, options_.tolerances.atol)),
        locates_(!switches_.none() && system_->discontinuity() == Discontinuity::kLocate),
        state_(system_->sizes()),
        next_(system_->sizes()) {
    refuseIllegal(scheme_, *system_, options_);
    jacobian_ = std::make_unique<SharedJacobian<Real>>(counted_, scheme_, options_, counters_);
    attempt_ = makeStepAttempt<Real>(counted_, scheme_, options_, *jacobian_, norm_, counters_);
    controller_ = makeController(options_.step, scheme_.tableau.order);
  }

  Solution<Real> integrate(const State<Real>& start, const Real& t_end,
                           const Monitor<Real>& monitor) {
    counters_ = {};
    monitor_ = &monitor;
    detail_.clear();
    chatter_ = {};
    attempt_->forget();
    jacobian_->forget();
    if (controller_) controller_->forget();
    state_ = system_->fromScene(start);
    if (!(state_.t <= t_end)) {
      throw Misuse("t_end = " + std::to_string(static_cast<double>(t_end)) +
                   " lies before the start, t = " + std::to_string(static_cast<double>(state_.t)));
    }
    length_ = static_cast<double>(Real(t_end - state_.t));
    const Outcome modes = settle(state_);
    if (modes != Outcome::kSuccess) return failed(modes, 0, "no step taken");
    const StartReport report =
        makeConsistent<Real>(counted_, options_.derivatives, scheme_.first > 0, state_);
    if (report.outcome != Outcome::kSuccess) return solution(report.outcome, report.detail);
    if (options_.step.control == StepControl::kFixed) return fixedSteps(t_end);
    return adaptiveSteps(t_end);
  }

 private:
  Solution<Real> solution(Outcome outcome, std::string detail = {}) const {
    return {outcome, std::move(detail), system_->toScene(state_), counters_};
  }

  Solution<Real> failed(Outcome outcome, double h, const char* what) const {
    std::ostringstream text;
    text.precision(6);
    text << what << " at t = " << static_cast<double>(state_.t) << ", h = " << h;
    if (blamed_ >= 0) text << ", " << switches_.describe(blamed_);
    return solution(outcome, text.str());
  }

  Outcome askCaller() const {
    return monitor_->interrupt ? monitor_->interrupt() : Outcome::kSuccess;
  }

  void tell(Index i, const State<Real>& state) {
    if (!monitor_->switched) return;
    const State<Real> scene = system_->toScene(state);
    monitor_->switched({state.t, i, system_->switchName(i), scene});
  }

  // Due switches at a state, each counted and told.
  Outcome settle(State<Real>& state) {
    const SwitchReport report = switches_.settle(state, [&](Index i) {
      ++counters_.switches;
      tell(i, state);
    });
    blamed_ = report.outcome == Outcome::kSuccess ? -1 : report.index;
    return report.outcome;
  }

  // Takes next_ over; in the modes that do not locate, a change of mode has already happened in it.
  void accept(const AttemptResult& result, double h) {
    const bool switched = !locates_ && next_.d != state_.d;
    std::swap(state_, next_);
    ++counters_.steps_accepted;
    if (switched) {
      ++counters_.switches;
      tell(result.switched, state_);
      if (system_->discontinuity() == Discontinuity::kIterate) restart();
    }
    if (!locates_ && chatter_.step(switched)) {
      ++counters_.chattering;
      std::ostringstream text;
      text << "chattering: " << switches_.describe(result.switched) << " switches in every step at t = "
           << static_cast<double>(state_.t);
      if (detail_.empty()) detail_ = text.str();
    }
    if (!monitor_->accepted) return;
    const State<Real> scene = system_->toScene(state_);
    monitor_->accepted({state_.t, h, result.error, result.newton_iterations, scene});
  }

  // Nothing of the steps before a change of mode is of use after it.
  void restart() {
    attempt_->forget();
    jacobian_->markStale();
    if (controller_) controller_->forget();
  }

  // `locate`: shortens the solved step to the first switch in it, accepts it, and restarts with the
  // new mode and consistent (a, k, z).
  Outcome acceptLocated(AttemptResult result, Real h, const Real& end, bool& shortened) {
    const Location<Real> at = locator_.locate(*attempt_, state_, h, next_);
    blamed_ = at.outcome == Outcome::kSuccess ? -1 : at.index;
    if (at.outcome != Outcome::kSuccess) return at.outcome;
    shortened = at.found && at.h < h;
    if (at.found) {
      result = at.attempt;
      h = at.h;
    }
    if (!shortened) next_.t = end;
    accept(result, static_cast<double>(h));
    if (!at.found) return Outcome::kSuccess;
    ++counters_.located_events;
    if (chatter_.event(static_cast<double>(state_.t), length_)) {
      ++counters_.chattering;
      blamed_ = at.index;
      return Outcome::kChattering;
    }
    const Outcome modes = settle(state_);
    if (modes != Outcome::kSuccess) return modes;
    restart();
    const StartReport report = makeConsistent<Real>(counted_, options_.derivatives,
                                                    scheme_.first > 0, state_, StartCheck::kNone);
    detail_ = report.detail;
    return report.outcome;
  }

  // N equal steps if h divides the interval to 1e-9, else a shorter last one. A located switch
  // splits a step.
  Solution<Real> fixedSteps(const Real& t_end) {
    const Real t0 = state_.t;
    const double count = std::ceil(length_ / options_.step.h * (1 - 1e-9));
    const auto steps = static_cast<std::int64_t>(count);
    const bool divides = std::abs(count * options_.step.h - length_) <= 1e-9 * length_;
    const Real h = divides ? Real((t_end - t0) / Real(count)) : Real(options_.step.h);
    if (count > static_cast<double>(options_.step.max_steps)) {
      return failed(Outcome::kMaxSteps, static_cast<double>(h), "too many steps asked for");
    }
    for (std::int64_t i = 0; i < steps; ++i) {
      const Real end = i + 1 == steps ? t_end : Real(t0 + Real(static_cast<double>(i + 1)) * h);
      bool whole = true;
      while (state_.t < end) {
        const Outcome caller = askCaller();
        if (caller != Outcome::kSuccess) return failed(caller, static_cast<double>(h), "stopped");
        const Real step = whole && (divides || i + 1 < steps) ? h : Real(end - state_.t);
        norm_.update(state_);
        const AttemptResult result = attempt_->attempt(state_, step, next_);
        if (result.outcome != Outcome::kSuccess) {
          ++counters_.steps_rejected_newton;
          blamed_ = result.outcome == Outcome::kChattering ? result.switched : -1;
          return failed(result.outcome, static_cast<double>(step), "step not solved");
        }
        bool shortened = false;
        if (locates_) {
          const Outcome outcome = acceptLocated(result, step, end, shortened);
          if (outcome != Outcome::kSuccess) {
            return failed(outcome, static_cast<double>(step), "switch not passed");
          }
          if (static_cast<double>(Real(end - state_.t)) < smallestStep()) state_.t = end;
        } else {
          next_.t = end;
          accept(result, static_cast<double>(step));
        }
        whole = false;
      }
    }
    return solution(Outcome::kSuccess, detail_);
  }

  // HW I (II.4), first guess: the solution moves by a hundredth of its size.
  double firstStep() const {
    if (options_.step.h > 0) return std::min(options_.step.h, length_);
    const auto size = [](const auto& y) { return static_cast<double>(Real(y.norm())); };
    const double y = size(state_.u) + size(state_.v) + size(state_.x);
    const double dy = size(state_.v) + size(state_.a()) + size(state_.k());
    const double h = y > 1e-5 && dy > 1e-5 ? 0.01 * y / dy : 1e-4 * length_;
    return std::min(h, 0.1 * length_);
  }

  Solution<Real> adaptiveSteps(const Real& t_end) {
    if (length_ == 0) return solution(Outcome::kSuccess);
    double h = std::min(firstStep(), options_.step.h_max);
    for (std::int64_t attempts = 0; state_.t < t_end; ++attempts) {
      const Outcome caller = askCaller();
      if (caller != Outcome::kSuccess) return failed(caller, h, "stopped");
      if (attempts == options_.step.max_steps) {
        return failed(Outcome::kMaxSteps, h, "too many steps");
      }
      const double least = std::max(options_.step.h_min, smallestStep());
      if (h < least) return failed(worst_failure_, h, "step too small");
      const Real left = t_end - state_.t;
      const bool last = h * (1 + 1e-10) >= static_cast<double>(left);
      const Real step = last ? left : Real(h);
      norm_.update(state_);
      const AttemptResult result = attempt_->attempt(state_, step, next_);
      if (result.outcome != Outcome::kSuccess) {
        ++counters_.steps_rejected_newton;
        worst_failure_ = result.outcome == Outcome::kNewtonFailed ? Outcome::kStepTooSmall
                                                                  : result.outcome;
        blamed_ = result.outcome == Outcome::kChattering ? result.switched : -1;
        attempt_->forget();
        h = controller_->afterFailure(static_cast<double>(step));
        continue;
      }
      const StepDecision decision = controller_->decide(result.error, static_cast<double>(step));
      // A last step cut short says nothing against the size that was asked for.
      h = std::min(last && decision.accept ? std::max(h, decision.h) : decision.h,
                   options_.step.h_max);
      if (!decision.accept) {
        ++counters_.steps_rejected_error;
        worst_failure_ = Outcome::kStepTooSmall;
        attempt_->forget();
        h = recommended(result, static_cast<double>(step), h, least);
        continue;
      }
      if (locates_) {
        bool shortened = false;
        const Real end = last ? t_end : next_.t;
        const Outcome outcome = acceptLocated(result, step, end, shortened);
        if (outcome != Outcome::kSuccess) {
          return failed(outcome, static_cast<double>(step), "switch not passed");
        }
        // What is left after a switch at the end is no step.
        if (static_cast<double>(Real(t_end - state_.t)) < smallestStep()) state_.t = t_end;
        continue;
      }
      if (last) next_.t = t_end;
      accept(result, static_cast<double>(step));
    }
    return solution(Outcome::kSuccess, detail_);
  }

  // `iterate`: after a rejection with a switch in the step, the next one ends just before it. What
  // is left is crossed by a step so small that the mode may be wrong in it.
  static double recommended(const AttemptResult& result, double step, double h, double least) {
    constexpr double kJustBefore = 0.98;
    const double before = kJustBefore * result.switch_at * step;
    return before > least ? before : h;
  }

  // Below this, t + c_i h no longer resolves the stages.
  double smallestStep() const {
    const double eps = static_cast<double>(Real(Eigen::NumTraits<Real>::epsilon()));
    return std::max(16 * eps * std::abs(static_cast<double>(state_.t)),
                    std::numeric_limits<double>::min());
  }

  std::shared_ptr<const System<Real>> system_;
  IntegratorOptions options_;
  Counters counters_;
  CountingSystem<Real> counted_;
  Scheme<Real> scheme_;
  ErrorNorm<Real> norm_;
  Switches<Real> switches_;
  EventLocator<Real> locator_;
  bool locates_;
  std::unique_ptr<SharedJacobian<Real>> jacobian_;
  std::unique_ptr<StepAttempt<Real>> attempt_;
  std::unique_ptr<StepController> controller_;
  State<Real> state_, next_;
  ChatterDetector chatter_;
  const Monitor<Real>* monitor_ = nullptr;
  std::string detail_;
  double length_ = 0;
  Index blamed_ = -1;
  Outcome worst_failure_ = Outcome::kStepTooSmall;
};

template <class Real>
Integrator<Real>::Integrator(std::shared_ptr<const System<Real>> system,
                             const Tableau<Real>& tableau, const IntegratorOptions& options,
                             const Vec<double>& scale)
    : run_(std::make_unique<Run>(std::move(system), tableau, options, scale)) {}
template <class Real>
Integrator<Real>::~Integrator() = default;
template <class Real>
Integrator<Real>::Integrator(Integrator&&) noexcept = default;

template <class Real>
Solution<Real> Integrator<Real>::integrate(const State<Real>& start, const Real& t_end,
                                           const Monitor<Real>& monitor) {
  return run_->integrate(start, t_end, monitor);
}

IRK_INSTANTIATE_CLASS(Integrator)

}  // namespace irk
