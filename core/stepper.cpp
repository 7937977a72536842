#include "core/stepper.h"

#include <algorithm>

#include "core/multiprecision.h"

namespace irk {
namespace {

// Modes of a step that still change after this many repetitions have no solution in it.
constexpr int kDiscontinuousIterations = 10;
// An error, in tolerances, for a switch that the ends of a step do not show.
constexpr double kUnseenSwitch = 1e3;

template <class Real>
StageSolverSetup<Real> setupOf(const System<Real>& system, const Scheme<Real>& scheme,
                               const IntegratorOptions& options) {
  return {scheme.implicitA(), nullptr, system.rowPowers(), system.sizes(), options.threads};
}

}  // namespace

template <class Real>
Stepper<Real>::Stepper(const System<Real>& system, const Scheme<Real>& scheme,
                       const IntegratorOptions& options, SharedJacobian<Real>& jacobian,
                       const ErrorNorm<Real>& norm, Counters& counters)
    : system_(system),
      counters_(counters),
      eq_(system, scheme, options.summation, options.threads),
      matrix_(jacobian, options.solver, setupOf(system, scheme, options), counters),
      stagewise_(jacobian, setupOf(system, scheme, options), options.newton.kind, counters),
      newton_(makeNewton(options, system.sizes(), scheme)),
      norm_(norm),
      start_values_(options.predictor, scheme),
      W_(system.sizes().n(), scheme.s),
      switches_(system),
      frozen_(system.sizes()),
      first_mode_(system.sizes()),
      defect_(system.sizes().n(), 1),
      row_weights_(system.sizes().n()),
      sees_switches_(options.step.estimate == ErrorEstimate::kRichardson),
      ones_(Vec<double>::Ones(system.sizes().components())),
      g_before_(system.sizes().switches) {
  stages_.scheme = &scheme;
  stages_.W.setZero(system.sizes().n(), scheme.s);
  if (system.projectsVelocity()) {
    projection_ = std::make_unique<VelocityProjection<Real>>(system, options.derivatives, counters);
  }
}

template <class Real>
void Stepper<Real>::solve(const StagePolynomial<Real>& past, const State<Real>& from, const Real& h,
                          State<Real>& to, JacobianUse use, StepResult& result) {
  eq_.begin(from, h);
  start_values_.fill(past, from, h, W_);
  NewtonContext<Real> context{eq_, matrix_, stagewise_, norm_, counters_, use};
  const NewtonResult newton = newton_->solve(context, W_);
  result.newton_iterations += newton.iterations;
  result.theta = std::max(result.theta, newton.theta);
  result.outcome = newton.outcome;
  if (newton.outcome != Outcome::kSuccess) return;
  eq_.finish(W_, to);
  if (projection_) result.outcome = projection_->apply(to);
}

template <class Real>
StepResult Stepper<Real>::attempt(const StagePolynomial<Real>& past, const State<Real>& from,
                                  const Real& h, State<Real>& to, JacobianUse use) {
  StepResult result;
  solve(past, from, h, to, use, result);
  stages_.valid = result.outcome == Outcome::kSuccess;
  if (!stages_.valid) return result;
  if (!switches_.none()) {
    switch (system_.discontinuity()) {
      case Discontinuity::kIgnore:
      case Discontinuity::kSmooth:
        settle(from, h, to, result);
        break;
      case Discontinuity::kIterate:
        iterateModes(past, from, h, to, result);
        break;
      case Discontinuity::kLocate:
        break;
    }
    stages_.valid = result.outcome == Outcome::kSuccess;
    if (!stages_.valid) return result;
  }
  stages_.t = from.t;
  stages_.h = h;
  stages_.W = W_;
  return result;
}

// The mode at the end, in which the next step starts; `smooth` takes it as a hint only. Doubling is
// blind to a jump before the first stage of the whole step and of its first half: both carry the
// same new mode from the start. There the polynomial of the stages misses the (a, k) that the step
// began with, and h times the difference bounds what the wrong mode does.
template <class Real>
void Stepper<Real>::settle(const State<Real>& from, const Real& h, State<Real>& to,
                           StepResult& result) {
  const bool smooth = system_.discontinuity() == Discontinuity::kSmooth;
  const SwitchReport report = switches_.settle(to, smooth ? Jumps::kNone : Jumps::kDone);
  if (!smooth) result.outcome = report.outcome;
  if (report.index >= 0) result.switched = report.index;
  if (report.count == 0 || !sees_switches_) return;
  defect_.noalias() = W_ * eq_.scheme().start;
  defect_ -= from.w;
  defect_.bottomRows(from.z().size()).setZero();  // multipliers jump, u, v, x do not
  norm_.rowWeights(static_cast<double>(h), row_weights_);
  result.mode_error = norm_.increment(defect_, 0, row_weights_);
}

// The discrete state is frozen over the step, updated at its end, and the step solved again with
// the new one until it stays: HOTINT's discontinuous iteration.
template <class Real>
void Stepper<Real>::iterateModes(const StagePolynomial<Real>& past, const State<Real>& from,
                                 const Real& h, State<Real>& to, StepResult& result) {
  result.switch_at = firstDue(from, to);
  done_.clear();
  first_mode_ = to;
  std::vector<Index> done;
  for (int i = 0;; ++i) {
    done.clear();
    const SwitchReport report =
        switches_.settle(to, Jumps::kDone, [&](Index k) { done.push_back(k); });
    if (report.index >= 0) result.switched = report.index;
    result.outcome = report.outcome;
    if (report.outcome != Outcome::kSuccess) return;
    if (done.empty()) break;
    if (i == kDiscontinuousIterations) {
      result.outcome = Outcome::kChattering;
      return;
    }
    ++counters_.discontinuous_iterations;
    done_.insert(done_.end(), done.begin(), done.end());
    frozen_ = from;
    frozen_.d = to.d;
    solve(past, frozen_, h, to, JacobianUse::kKeep, result);
    if (result.outcome != Outcome::kSuccess) return;
  }
  if (done_.empty()) {
    if (dueInside()) result.mode_error = kUnseenSwitch;
    return;
  }
  // Multipliers jump with the mode; u, v, x do not.
  first_mode_.w = to.w;
  result.mode_error = norm_.difference(first_mode_, to, static_cast<double>(h), ones_);
  for (const Index k : done_) system_.jump(k, to);
}

// Whether a switch is due at a stage although none is at the end: a mode that comes and goes.
template <class Real>
bool Stepper<Real>::dueInside() {
  for (Index i = eq_.scheme().first; i < eq_.scheme().s; ++i) {
    if (switches_.evaluate(eq_.stage(W_, i)).outcome != Outcome::kSuccess) return true;
    if (switches_.due() >= 0) return true;
  }
  return false;
}

// The secant's root of the first switching function that is due at `to`.
template <class Real>
double Stepper<Real>::firstDue(const State<Real>& from, const State<Real>& to) {
  double first = std::numeric_limits<double>::quiet_NaN();
  if (switches_.evaluate(from).outcome != Outcome::kSuccess) return first;
  g_before_ = switches_.g();
  if (switches_.evaluate(to).outcome != Outcome::kSuccess) return first;
  for (Index i = 0; i < g_before_.size(); ++i) {
    const double before = static_cast<double>(g_before_[i]);
    const double after = static_cast<double>(switches_.g()[i]);
    if (after > 0 && before < 0) first = std::fmin(first, -before / (after - before));
  }
  return first;
}

IRK_INSTANTIATE_CLASS(Stepper)

}  // namespace irk
