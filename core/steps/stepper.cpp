#include "core/steps/stepper.h"

#include <algorithm>

#include "irk/multiprecision.h"

namespace irk {
namespace {

// Modes of a step that still change after this many repetitions have no solution in it.
constexpr int kDiscontinuousIterations = 10;
// A first step after a restart follows the motion where the stages' polynomial misses (a, k) at its
// start by less than this part of what they change over the step.
constexpr double kFollows = 0.1;
// It is not asked for more than this, in tolerances: in index 3 a start within the tolerance changes
// velocities by as much, whatever the step.
constexpr double kStartTolerances = 10;

// Rates that differ from those before by this part of their size are those of another root.
constexpr double kAnotherRoot = 0.25;

// Estimates that look at the switches of a step in the mode `ignore`; the paper's do not.
bool seesSwitches(ErrorEstimate estimate) {
  return estimate == ErrorEstimate::kRichardson || estimate == ErrorEstimate::kEmbedded;
}

template <class Real>
bool hasHiddenUnknowns(const System<Real>& system) {
  const auto& powers = system.errorPowers().z;
  const auto multipliers = static_cast<std::ptrdiff_t>(system.sizes().constraints);
  return std::any_of(powers.begin() + multipliers, powers.end(), [](int power) { return power > 0; });
}

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
      other_mode_(system.sizes()),
      rates_(system.sizes().n()),
      row_weights_(system.sizes().n()),
      sees_switches_(seesSwitches(options.step.estimate)),
      has_hidden_unknowns_(hasHiddenUnknowns(system)),
      ones_(Vec<double>::Ones(system.sizes().components())),
      g_before_(system.sizes().switches) {
  stages_.scheme = &scheme;
  stages_.W.setZero(system.sizes().n(), scheme.s);
  if (system.projectsVelocity()) {
    projection_ = std::make_unique<VelocityProjection<Real>>(system, options.derivatives, counters);
  }
  if (!switches_.none() && system.discontinuity() != Discontinuity::kLocate) {
    scan_ = std::make_unique<SwitchScan<Real>>(system);
    consistent_ = std::make_unique<ConsistentStart<Real>>(system, options.derivatives, false);
  }
}

template <class Real>
void Stepper<Real>::solve(const StagePolynomial<Real>& past, const State<Real>& from, const Real& h,
                          State<Real>& to, JacobianUse use, StepResult& result) {
  eq_.begin(from, h);
  // Where modes change inside a solve or from one to the next, the contraction of the last one says nothing:
  // believed, it would end the iteration after one correction with the Jacobian of another mode.
  if (scan_) newton_->forget();
  start_values_.fill(past, from, h, W_);
  NewtonContext<Real> context{eq_, matrix_, stagewise_, norm_, counters_, use};
  const NewtonResult newton = newton_->solve(context, W_);
  result.newton_iterations += newton.iterations;
  result.theta = std::max(result.theta, newton.theta);
  result.round_off = std::max(result.round_off, newton.round_off);
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
  takeStages(from, h);
  switch (system_.discontinuity()) {
    case Discontinuity::kIgnore:
    case Discontinuity::kSmooth:
      if (!switches_.none()) followModes(from, h, to, result);
      break;
    case Discontinuity::kIterate:
      if (!switches_.none()) iterateModes(past, from, h, to, result);
      break;
    case Discontinuity::kLocate:
      break;
  }
  stages_.valid = result.outcome == Outcome::kSuccess;
  return result;
}

template <class Real>
void Stepper<Real>::takeStages(const State<Real>& from, const Real& h) {
  stages_.t = from.t;
  stages_.h = h;
  stages_.W = W_;
}

// h times a difference of (a, k) in the error norm. Multipliers jump with the mode; u, v, x do not.
template <class Real>
double Stepper<Real>::stepNorm(const Vec<Real>& dw, const Real& h) {
  const Sizes n = system_.sizes();
  norm_.rowWeights(static_cast<double>(h), row_weights_);
  double sum = 0;
  for (Index i = 0; i < n.nu + n.nx; ++i) {
    const double e = static_cast<double>(dw[i]);
    sum += row_weights_[i] * e * e;
  }
  return std::sqrt(sum / static_cast<double>(n.components()));
}

// From the start of the step to one of its stages.
template <class Real>
double Stepper<Real>::largestChange(const State<Real>& from, const Real& h) {
  double most = 0;
  for (Index i = 0; i < W_.cols(); ++i) {
    rates_ = W_.col(i) - from.w;
    most = std::max(most, stepNorm(rates_, h));
  }
  return most;
}

template <class Real>
double Stepper<Real>::startDefect(const State<Real>& from) {
  rates_.noalias() = W_ * eq_.scheme().start;
  rates_ -= from.w;
  const double missed = stepNorm(rates_, stages_.h);
  const double changed = largestChange(from, stages_.h);
  return missed > kStartTolerances && missed > kFollows * changed ? missed : 0;
}

template <class Real>
bool Stepper<Real>::leavesRoot(const State<Real>& from) {
  // A step that moves the solution by more than a tolerance may change its rates.
  if (!has_hidden_unknowns_) return false;
  rates_ = W_.col(W_.cols() - 1);
  if (stepNorm(rates_, stages_.h) > 1) return false;
  const Index n = system_.sizes().nu + system_.sizes().nx;
  rates_.noalias() = W_ * eq_.scheme().start;
  const Real size = rates_.head(n).norm() + from.w.head(n).norm();
  return (rates_.head(n) - from.w.head(n)).norm() > Real(kAnotherRoot) * size;
}

template <class Real>
int Stepper<Real>::decay() const {
  return static_cast<int>(W_.cols()) - highest() + 1;
}

template <class Real>
double Stepper<Real>::roughness(const State<Real>& from) {
  // One coefficient alone has zeros as a jump moves through the step, two neighbours have none in common.
  double sum = 0;
  for (Index k = W_.cols() - highest(); k < W_.cols(); ++k) {
    rates_.noalias() = W_ * eq_.scheme().legendre_inverse_transposed.col(k);
    const double size = stepNorm(rates_, stages_.h);
    sum += size * size;
  }
  if (eq_.scheme().stiffly_accurate) {
    rates_.noalias() = W_ * eq_.scheme().start;
    rates_ -= from.w;
    const double missed = stepNorm(rates_, stages_.h);
    if (missed > kStartTolerances) sum += missed * missed;
  }
  return std::sqrt(sum);
}

// The mode at the end, in which the next step starts; `smooth` takes it as a hint only. No doubling
// can be trusted in a step with a switch: both solutions carry the same wrong mode before their first
// stage and behind their last, and between two stages. What the switch does over the whole step bounds
// the error.
template <class Real>
void Stepper<Real>::followModes(const State<Real>& from, const Real& h, State<Real>& to,
                                StepResult& result) {
  const bool smooth = system_.discontinuity() == Discontinuity::kSmooth;
  first_mode_ = to;
  const SwitchReport report = switches_.settle(to, smooth ? Jumps::kNone : Jumps::kDone);
  if (report.index >= 0) result.switched = report.index;
  if (!smooth) result.outcome = report.outcome;
  if (!sees_switches_ || result.outcome != Outcome::kSuccess) return;
  Index inside = -1;
  if (report.count == 0 && !dueInside(from, first_mode_, inside)) return;
  if (inside >= 0) result.switched = inside;
  result.mode_error = changeInStep(from, h, to);
}

// The largest change of (a, k) from the step's start to a stage, and at the step's end to the mode that
// begins there; and what the switch corrects in u, v, x.
template <class Real>
double Stepper<Real>::changeInStep(const State<Real>& from, const Real& h, const State<Real>& to) {
  double most = largestChange(from, h);
  most = std::max(most, norm_.difference(first_mode_, to, static_cast<double>(h), ones_));
  other_mode_ = to;
  return std::max(most, modeChange(h));
}

// h times the change of (a, k) from those of `other_mode_` to what its discrete state makes of them.
template <class Real>
double Stepper<Real>::modeChange(const Real& h) {
  rates_ = other_mode_.w;
  const StartReport report = consistent_->apply(other_mode_, StartCheck::kNone);
  // What cannot be determined cannot be trusted.
  if (report.outcome != Outcome::kSuccess) return std::numeric_limits<double>::infinity();
  rates_ -= other_mode_.w;
  return stepNorm(rates_, h);
}

// Whether a switch is due inside the step, whatever is at its end. `other_mode_`: the state there, in
// the mode that follows.
template <class Real>
bool Stepper<Real>::dueInside(const State<Real>& from, const State<Real>& to, Index& index) {
  const auto due = scan_->first(from, stages_, to);
  if (scan_->report().outcome != Outcome::kSuccess) index = scan_->report().index;
  if (!due.empty()) {
    index = due.front().index;
    other_mode_ = scan_->at(due.front().high);
    return true;
  }
  // A switch can be due at a stage that lies between two samples.
  for (Index i = eq_.scheme().first; i < eq_.scheme().s && index < 0; ++i) {
    const SwitchReport report = switches_.evaluate(eq_.stage(W_, i));
    index = report.outcome == Outcome::kSuccess ? switches_.due() : report.index;
    if (index >= 0) other_mode_ = scan_->at(eq_.scheme().c[i]);
  }
  return index >= 0;
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
    takeStages(frozen_, h);
  }
  Index inside = -1;
  if (done_.empty()) {
    if (!dueInside(from, to, inside)) return;
    result.switched = inside;
    const SwitchReport report = switches_.settle(other_mode_, Jumps::kNone);
    result.mode_error = report.outcome == Outcome::kSuccess
                            ? modeChange(h)
                            : std::numeric_limits<double>::infinity();
    return;
  }
  // Multipliers jump with the mode; u, v, x do not.
  first_mode_.w = to.w;
  result.mode_error = norm_.difference(first_mode_, to, static_cast<double>(h), ones_);
  for (const Index k : done_) system_.jump(k, to);
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
