#include "core/integrator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "core/consistent_start.h"
#include "core/controller.h"
#include "core/counting.h"
#include "core/multiprecision.h"
#include "core/step_attempt.h"

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
void refuseIllegal(const Scheme<Real>& scheme, const Sizes& n, const IntegratorOptions& options) {
  if (n.nz > 0 && !scheme.allowsAlgebraic()) {
    throw Misuse("illegal combination: method '" + scheme.tableau.id + "' with a system of " +
                 std::to_string(n.nz) + " algebraic unknowns: A is singular, the stages do not "
                 "determine them");
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
        state_(system_->sizes()),
        next_(system_->sizes()) {
    refuseIllegal(scheme_, system_->sizes(), options_);
    jacobian_ = std::make_unique<SharedJacobian<Real>>(counted_, options_.derivatives,
                                                       options_.jacobian_point, counters_);
    attempt_ = makeStepAttempt<Real>(counted_, scheme_, options_, *jacobian_, norm_, counters_);
  }

  Solution<Real> integrate(const State<Real>& start, const Real& t_end,
                           const Monitor<Real>& monitor) {
    counters_ = {};
    attempt_->rejected();
    jacobian_->markStale();
    state_ = system_->fromScene(start);
    const StartReport report =
        makeConsistent<Real>(counted_, options_.derivatives, scheme_.first > 0, state_);
    if (report.outcome != Outcome::kSuccess) return solution(report.outcome, report.detail);
    if (!(state_.t <= t_end)) {
      throw Misuse("t_end = " + std::to_string(static_cast<double>(t_end)) +
                   " lies before the start, t = " + std::to_string(static_cast<double>(state_.t)));
    }
    if (options_.step.control == StepControl::kFixed) return fixedSteps(t_end, monitor);
    return adaptiveSteps(t_end, monitor);
  }

 private:
  Solution<Real> solution(Outcome outcome, std::string detail = {}) const {
    return {outcome, std::move(detail), system_->toScene(state_), counters_};
  }

  Solution<Real> failed(Outcome outcome, double h, const char* what) const {
    std::ostringstream text;
    text.precision(6);
    text << what << " at t = " << static_cast<double>(state_.t) << ", h = " << h;
    return solution(outcome, text.str());
  }

  static Outcome askCaller(const Monitor<Real>& monitor) {
    return monitor.interrupt ? monitor.interrupt() : Outcome::kSuccess;
  }

  void accept(const AttemptResult& result, double h, const Monitor<Real>& monitor) {
    std::swap(state_, next_);
    ++counters_.steps_accepted;
    if (monitor.accepted) {
      const State<Real> scene = system_->toScene(state_);
      monitor.accepted({state_.t, h, result.error, result.newton_iterations, scene});
    }
  }

  // N equal steps if h divides the interval to 1e-9, else a shorter last one.
  Solution<Real> fixedSteps(const Real& t_end, const Monitor<Real>& monitor) {
    const Real t0 = state_.t;
    const double length = static_cast<double>(Real(t_end - t0));
    const double count = std::ceil(length / options_.step.h * (1 - 1e-9));
    const auto steps = static_cast<std::int64_t>(count);
    const bool divides = std::abs(count * options_.step.h - length) <= 1e-9 * length;
    const Real h = divides ? Real((t_end - t0) / Real(count)) : Real(options_.step.h);
    if (count > static_cast<double>(options_.step.max_steps)) {
      return failed(Outcome::kMaxSteps, static_cast<double>(h), "too many steps asked for");
    }
    for (std::int64_t i = 0; i < steps; ++i) {
      const Outcome caller = askCaller(monitor);
      if (caller != Outcome::kSuccess) return failed(caller, static_cast<double>(h), "stopped");
      const bool last = i + 1 == steps;
      const Real step = last ? Real(t_end - state_.t) : h;
      norm_.update(state_);
      const AttemptResult result =
          attempt_->attempt(state_, divides ? h : step, next_);
      if (result.outcome != Outcome::kSuccess) {
        ++counters_.steps_rejected_newton;
        return failed(result.outcome, static_cast<double>(h), "step not solved");
      }
      next_.t = last ? t_end : Real(t0 + Real(static_cast<double>(i + 1)) * h);
      accept(result, static_cast<double>(step), monitor);
    }
    return solution(Outcome::kSuccess);
  }

  // HW I (II.4), first guess: the solution moves by a hundredth of its size.
  double firstStep(double length) const {
    if (options_.step.h > 0) return std::min(options_.step.h, length);
    const auto size = [](const auto& y) { return static_cast<double>(Real(y.norm())); };
    const double y = size(state_.u) + size(state_.v) + size(state_.x);
    const double dy = size(state_.v) + size(state_.a()) + size(state_.k());
    const double h = y > 1e-5 && dy > 1e-5 ? 0.01 * y / dy : 1e-4 * length;
    return std::min(h, 0.1 * length);
  }

  Solution<Real> adaptiveSteps(const Real& t_end, const Monitor<Real>& monitor) {
    const double length = static_cast<double>(Real(t_end - state_.t));
    if (length == 0) return solution(Outcome::kSuccess);
    const auto controller = makeController(options_.step, scheme_.tableau.order);
    double h = std::min(firstStep(length), options_.step.h_max);
    for (std::int64_t attempts = 0; state_.t < t_end; ++attempts) {
      const Outcome caller = askCaller(monitor);
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
        attempt_->rejected();
        h = controller->afterFailure(static_cast<double>(step));
        continue;
      }
      const StepDecision decision = controller->decide(result.error, static_cast<double>(step));
      // A last step cut short says nothing against the size that was asked for.
      h = std::min(last && decision.accept ? std::max(h, decision.h) : decision.h,
                   options_.step.h_max);
      if (!decision.accept) {
        ++counters_.steps_rejected_error;
        worst_failure_ = Outcome::kStepTooSmall;
        attempt_->rejected();
        continue;
      }
      if (last) next_.t = t_end;
      accept(result, static_cast<double>(step), monitor);
    }
    return solution(Outcome::kSuccess);
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
  std::unique_ptr<SharedJacobian<Real>> jacobian_;
  std::unique_ptr<StepAttempt<Real>> attempt_;
  State<Real> state_, next_;
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
