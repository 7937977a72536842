#include "irk/integrator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/control/stall_detector.h"
#include "core/estimates/accumulation.h"
#include "core/integration/advance.h"
#include "core/system/counting.h"
#include "core/system/first_order.h"
#include "irk/multiprecision.h"
#include "irk/system_check.h"

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
std::shared_ptr<const System<Real>> checked(std::shared_ptr<const System<Real>> system,
                                            const Vec<double>& scale) {
  requireSystem(system.get(), scale);
  return system;
}

template <class Real>
void refuseIllegal(const Scheme<Real>& scheme, const System<Real>& system,
                   const IntegratorOptions& options) {
  const Sizes n = system.sizes();
  if (n.nz > 0 && !scheme.allowsAlgebraic()) {
    throw Misuse("illegal combination: method '" + scheme.tableau.id + "' with a system of " +
                 std::to_string(n.nz) +
                 " algebraic unknowns: A is singular, the stages do not "
                 "determine them");
  }
  const bool each_stage = options.jacobian_point == JacobianPoint::kEachStage;
  const bool full = options.newton.kind == NewtonKind::kFull;
  const bool decoupled =
      options.solver == StageSolverKind::kSchur || options.solver == StageSolverKind::kEigen;
  if ((each_stage || full) && decoupled) {
    throw Misuse(std::string("illegal combination: ") +
                 (full ? "newton 'full'" : "jacobian_point 'each_stage'") + " with solver '" +
                 std::string(idOf(options.solver)) +
                 "': stage-wise derivatives do not decouple; use solver 'coupled_dense' or 'coupled_sparse'");
  }
  if (full && options.step.estimate == ErrorEstimate::kEmbedded) {
    throw Misuse("illegal combination: newton 'full' with estimate 'embedded': the estimate filters "
                 "with the kept Jacobian, and 'full' keeps none; use estimate 'richardson'");
  }
  if (options.threads > 1 && dynamic_cast<const FirstOrderForm<Real>*>(&system)) {
    throw Misuse("illegal combination: threads = " + std::to_string(options.threads) +
                 " with formulation 'first_order': it keeps factors, one thread at a time");
  }
  if (options.order == OrderControl::kVariable &&
      (options.step.estimate != ErrorEstimate::kEmbedded || each_stage)) {
    throw Misuse(std::string("illegal combination: order 'variable' with ") +
                 (each_stage ? "jacobian_point 'each_stage'"
                             : "estimate '" + std::string(idOf(options.step.estimate)) + "'") +
                 ": orders are compared by the embedded estimate with one Jacobian; use estimate "
                 "'embedded' and another jacobian_point");
  }
  if (options.jacobian != JacobianTerms::kFull && !system.secondOrder()) {
    throw Misuse("illegal combination: jacobian '" + std::string(idOf(options.jacobian)) +
                 "' with formulation 'ggl' or 'first_order': its accelerations are no unknowns of "
                 "their own");
  }
}

}  // namespace

template <class Real>
class Integrator<Real>::Run {
 public:
  Run(std::shared_ptr<const System<Real>> system, const Methods<Real>& methods,
      const IntegratorOptions& options, const Vec<double>& scale)
      : system_(checked(std::move(system), scale)),
        options_(validated(options)),
        counted_(*system_, counters_, options_.threads),
        schemes_(methods.members.begin(), methods.members.end()),
        norm_(counted_, options_.tolerances, scale),
        error_sum_(options_.tolerances) {
    const bool one = methods.members.size() == 1;
    if (methods.start >= methods.members.size() ||
        (!one && options_.order != OrderControl::kVariable)) {
      throw Misuse("illegal combination: order '" + std::string(idOf(options_.order)) + "' with " +
                   std::to_string(methods.members.size()) + " methods, starting with number " +
                   std::to_string(methods.start) + ": several need order 'variable'");
    }
    const Scheme<Real>& scheme = schemes_[methods.start];
    for (const auto& member : schemes_) refuseIllegal(member, *system_, options_);
    const bool solved_anew = options_.multipliers == Multipliers::kConsistent;
    if (solved_anew && !dampsStiffErrors(scheme)) norm_.leaveMultipliersOut();
    jacobian_ = std::make_unique<SharedJacobian<Real>>(counted_, scheme, options_, counters_);
    attempt_ = makeStepAttempt<Real>(counted_, schemes_, methods.start, options_, *jacobian_, norm_,
                                     counters_);
    order_ = attempt_->order();
    controller_ = makeController(options_.step, order_);
    advance_ = std::make_unique<Advance<Real>>(counted_, scheme, options_, *attempt_, *jacobian_, norm_,
                                               controller_.get(), counters_);
  }

  Solution<Real> integrate(const State<Real>& start, const Real& t_end,
                           const Monitor<Real>& monitor) {
    counters_ = {};
    monitor_ = &monitor;
    requireStart(*system_, start, t_end);
    const std::string not_finite = notFinite(start);
    if (!not_finite.empty()) return {Outcome::kNotFinite, "at the start: " + not_finite, start, counters_};
    length_ = static_cast<double>(Real(t_end - start.t));
    const Outcome outcome = advance_->begin(start, length_, monitor);
    followOrder(1, 0);
    if (outcome != Outcome::kSuccess) return advance_->failed(outcome, 0, "no step taken");
    if (options_.step.control == StepControl::kFixed) return fixedSteps(t_end);
    return adaptiveSteps(t_end);
  }

 private:
  Outcome askCaller() const {
    return monitor_->interrupt ? monitor_->interrupt() : Outcome::kSuccess;
  }

  const State<Real>& state() const { return advance_->state(); }

  AttemptResult attempt(const Real& h) {
    norm_.update(state());
    const AttemptResult result = attempt_->attempt(state(), h, advance_->next());
    if (result.outcome != Outcome::kSuccess) {
      ++counters_.steps_rejected_newton;
      const bool mode = result.outcome == Outcome::kChattering || result.switched >= 0;
      advance_->blame(mode ? result.switched : -1);
    } else {
      advance_->blame(-1);
    }
    return result;
  }

  // What is left after a switch next to the end is no step.
  void reach(const Real& end) {
    if (state().t < end && static_cast<double>(Real(end - state().t)) < smallestStep()) {
      advance_->endAt(end);
    }
  }

  // N equal steps if h divides the interval to 1e-9, else a shorter last one. A located switch
  // splits a step.
  Solution<Real> fixedSteps(const Real& t_end) {
    const Real t0 = state().t;
    const double count = std::ceil(length_ / options_.step.h * (1 - 1e-9));
    const auto steps = static_cast<std::int64_t>(count);
    const bool divides = std::abs(count * options_.step.h - length_) <= 1e-9 * length_;
    const Real h = divides ? Real((t_end - t0) / Real(count)) : Real(options_.step.h);
    if (count > static_cast<double>(options_.step.max_steps)) {
      return advance_->failed(Outcome::kMaxSteps, static_cast<double>(h),
                              "too many steps asked for");
    }
    for (std::int64_t i = 0; i < steps; ++i) {
      const bool last = i + 1 == steps;
      const Real end = last ? t_end : Real(t0 + Real(static_cast<double>(i + 1)) * h);
      bool whole = divides || !last;
      while (state().t < end) {
        const Real step = whole ? h : Real(end - state().t);
        const double size = static_cast<double>(step);
        const Outcome caller = askCaller();
        if (caller != Outcome::kSuccess) return advance_->failed(caller, size, "stopped");
        const AttemptResult result = attempt(step);
        if (result.outcome != Outcome::kSuccess) {
          return advance_->failed(result.outcome, size, "step not solved");
        }
        const Outcome outcome = advance_->accept(result, step, end);
        if (outcome != Outcome::kSuccess) {
          return advance_->failed(outcome, size, "switch not passed");
        }
        reach(end);
        whole = false;
      }
    }
    return advance_->success();
  }

  // HW I (II.4), first guess: the solution moves by a hundredth of its size.
  double firstStep() const {
    if (options_.step.h > 0) return std::min(options_.step.h, length_);
    const auto size = [](const auto& y) { return static_cast<double>(Real(y.norm())); };
    const State<Real>& s = state();
    const double y = size(s.u) + size(s.v) + size(s.x);
    const double dy = size(s.v) + size(s.a()) + size(s.k());
    const double h = y > 1e-5 && dy > 1e-5 ? 0.01 * y / dy : 1e-4 * length_;
    return std::min(h, 0.1 * length_);
  }

  Solution<Real> adaptiveSteps(const Real& t_end) {
    if (length_ == 0) return advance_->success();
    double h = std::min(firstStep(), options_.step.h_max);
    stall_.begin(static_cast<double>(state().t));
    error_sum_.begin();
    Outcome worst = Outcome::kStepTooSmall;  // what a step below the smallest is called
    for (std::int64_t attempts = 0; state().t < t_end; ++attempts) {
      const Outcome caller = askCaller();
      if (caller != Outcome::kSuccess) return advance_->failed(caller, h, "stopped");
      if (attempts == options_.step.max_steps) {
        return advance_->failed(Outcome::kMaxSteps, h, "too many steps");
      }
      const double least = std::max(options_.step.h_min, smallestStep());
      if (h < least) return advance_->failed(worst, h, because("step too small").c_str());
      const bool stalls =
          attempts > 0 && stall_.attempted(static_cast<double>(state().t), h,
                                           static_cast<double>(t_end),
                                           options_.step.max_steps - attempts);
      if (stalls) {
        return advance_->failed(Outcome::kStalled, h, because("steps do not grow").c_str());
      }
      const Real left = t_end - state().t;
      const bool last = h * (1 + 1e-10) >= static_cast<double>(left);
      const Real step = last ? left : Real(h);
      const double size = static_cast<double>(step);
      const AttemptResult result = attempt(step);
      if (result.outcome != Outcome::kSuccess) {
        worst = result.outcome == Outcome::kNewtonFailed ? Outcome::kStepTooSmall : result.outcome;
        attempt_->forget();
        h = controller_->afterFailure(size);
        followOrder(1, 0);
        continue;
      }
      const StepDecision decision = controller_->decide(result.error, size);
      // A last step cut short says nothing against the size that was asked for.
      h = std::min(last && decision.accept ? std::max(h, decision.h) : decision.h,
                   options_.step.h_max);
      if (!decision.accept) {
        ++counters_.steps_rejected_error;
        worst = Outcome::kStepTooSmall;
        h = recommended(result, size, h, least);
        continue;
      }
      const Outcome outcome = advance_->accept(result, step, last ? t_end : advance_->next().t);
      if (outcome == Outcome::kNewtonFailed || outcome == Outcome::kSingular) {
        ++counters_.steps_rejected_newton;
        attempt_->forget();
        h = controller_->afterFailure(size);
        continue;
      }
      if (outcome != Outcome::kSuccess) {
        return advance_->failed(outcome, size, "switch not passed");
      }
      error_sum_.add(result.added);
      if (error_sum_.aboveBar()) {
        return advance_->failed(Outcome::kInaccurate, size, because("the steps' errors add up").c_str());
      }
      const NextStep next = attempt_->accepted(result, size, h);
      h = std::min(next.h, options_.step.h_max);
      followOrder(next.error, size);
      reach(t_end);
    }
    return advance_->success();
  }

  // What keeps steps small: the component with the largest error, or Newton.
  std::string because(const char* what) const {
    const Counters& c = counters_;
    std::string text = std::string(what) + " (" + std::to_string(c.steps_accepted) +
                       " accepted, rejected by the error " +
                       std::to_string(c.steps_rejected_error) + ", by Newton " +
                       std::to_string(c.steps_rejected_newton);
    const Index i = attempt_->worstComponent();
    if (i >= 0) text += "; largest error in " + componentName(i);
    return text + ")";
  }
  std::string componentName(Index i) const {
    const Sizes n = system_->sizes();
    const auto name = [&](const char* group, Index first) {
      return group + ("[" + std::to_string(i - first) + "]");
    };
    if (i < n.nu) return name("u", 0);
    if (i < 2 * n.nu) return name("v", n.nu);
    return i < 2 * n.nu + n.nx ? name("x", 2 * n.nu) : name("z", 2 * n.nu + n.nx);
  }

  // The controller's exponent is that of the next attempt's estimate.
  void followOrder(double error, double h) {
    if (attempt_->order() == order_) return;
    order_ = attempt_->order();
    controller_->changeOrder(order_, error, h);
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
    return std::max(16 * eps * std::abs(static_cast<double>(state().t)),
                    std::numeric_limits<double>::min());
  }

  std::shared_ptr<const System<Real>> system_;
  IntegratorOptions options_;
  Counters counters_;
  CountingSystem<Real> counted_;
  std::vector<Scheme<Real>> schemes_;
  ErrorNorm<Real> norm_;
  std::unique_ptr<SharedJacobian<Real>> jacobian_;
  std::unique_ptr<StepAttempt<Real>> attempt_;
  std::unique_ptr<StepController> controller_;
  std::unique_ptr<Advance<Real>> advance_;
  StallDetector stall_;
  ErrorSum error_sum_;
  const Monitor<Real>* monitor_ = nullptr;
  double length_ = 0;
  int order_;
};

template <class Real>
Integrator<Real>::Integrator(std::shared_ptr<const System<Real>> system,
                             const Methods<Real>& methods, const IntegratorOptions& options,
                             const Vec<double>& scale)
    : run_(std::make_unique<Run>(std::move(system), methods, options, scale)) {}
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
