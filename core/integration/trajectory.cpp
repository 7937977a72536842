#include "core/integration/trajectory.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "core/base/constants.h"
#include "core/derivatives/constraint_check.h"
#include "core/system/along_rates.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

// Errors of multipliers do not count if the method does not determine them and they are computed anew at the end.
template <class Real>
ErrorNorm<Real> normOf(const System<Real>& system, const Scheme<Real>& scheme, const IntegratorOptions& options,
                       const Vec<double>& scale) {
  ErrorNorm<Real> norm(system, options.tolerances, scale);
  const bool solved_anew = options.multipliers == Multipliers::kConsistent;
  if (solved_anew && !dampsStiffErrors(scheme)) norm.leaveMultipliersOut();
  return norm;
}

}  // namespace

template <class Real>
Trajectory<Real>::Trajectory(const System<Real>& system, const SchemeList<Real>& schemes, std::size_t start,
                             const IntegratorOptions& options, const Vec<double>& scale, Counters& counters)
    : system_(system),
      options_(options),
      counters_(counters),
      norm_(normOf(system, schemes[start], options, scale)),
      jacobian_(system, schemes[start], options, counters),
      attempt_(makeStepAttempt<Real>({system, schemes, start, options, jacobian_, norm_, counters})),
      order_(attempt_->order()),
      controller_(makeController(options.step, order_)),
      modes_(madeBy(catalogue<Discontinuity>()[system.discontinuity()].after_step.template of<Real>(),
                    system.discontinuity(), system, options)),
      start_(system, options.derivatives, schemes[start].first > 0, &counters, scale,
             jacobian_.differentiator().scratch()),
      amounts_(system, start_, counters),
      switches_(system),
      next_(system.sizes()) {
  if (system.errorPowers().isIndex3()) {
    projection_ = std::make_unique<VelocityProjection<Real>>(system, options.derivatives, counters);
  }
  const bool constrained = constrainedIn(system).sizes().constraints > 0;
  leaves_out_ = !constrainedIn(system).leftOut().empty();
  if (constrained) positions_ = std::make_unique<SingularPositions<Real>>(system, scale);
}

template <class Real>
Outcome Trajectory<Real>::begin(const State<Real>& start, double length, const Monitor<Real>& monitor) {
  monitor_ = &monitor;
  length_ = length;
  chatter_ = {};
  start_detail_.clear();
  blamed_ = -1;
  note_.clear();
  round_off_ = 0;
  last_rejection_ = nullptr;
  failures_ = 0;
  solved_ = rejected_ = false;
  last_h_ = Real(0);
  earlier_.reset();
  attempt_->begin(length);
  switches_.begin();
  modes_->begin(static_cast<double>(start.t), length);
  attempt_->keepPieces(monitor.inside);
  if (monitor.inside && !inside_) inside_.emplace(system_);
  jacobian_.forgetPattern();
  restart();
  followOrder(1, 0);
  state_ = system_.fromScene(start);
  const Outcome modes = modes_->settlesAtStart() ? settle() : Outcome::kSuccess;
  if (modes != Outcome::kSuccess) return modes;
  start_.forgetPattern();
  if (projection_) projection_->forgetPattern();
  const StartReport report = start_.apply(state_);
  start_detail_ = report.detail;
  determined_ = report.determined;
  if (!switches_.none() && report.determined) attempt_->restart();
  if (positions_) positions_->begin(state_);
  if (controller_) amounts_.begin(state_, norm_);
  return report.outcome;
}

// In index 3 Newton's method may leave kNewtonPart kHiddenPart of a tolerance in g(u). The next step turns it into a
// change of velocities that is last_h / h times as large: more than kHiddenPart of a tolerance if h is shorter than
// this. Where the estimate has rejected a step, that may be the cause, which still shorter steps make larger.
template <class Real>
bool Trajectory<Real>::isShortAfterLast(const Real& h) const {
  return projection_ && controller_ && h < Real(rejected_ ? 1 : kNewtonPart.value) * last_h_;
}

// Projects positions and velocities to their constraints. False, with the state as before, if that cannot be done or
// moves a position by more than a drift may be, as near a singular position.
template <class Real>
bool Trajectory<Real>::satisfyConstraints() {
  last_h_ = Real(0);
  next_ = state_;
  if (projection_->applyToPositions(next_) != Outcome::kSuccess) return false;
  for (Index i = 0; i < next_.u.size(); ++i) {
    const double moved = std::abs(static_cast<double>(Real(next_.u[i] - state_.u[i])));
    if (!(moved <= kAllowedDrift * norm_.weights()[i])) return false;
  }
  std::swap(state_, next_);
  if (failures_ > 1) solveAlgebraicUnknowns();
  return true;
}

template <class Real>
AttemptResult Trajectory<Real>::attempt(const Real& h) {
  norm_.update(state_);
  if (isShortAfterLast(h)) satisfyConstraints();
  const AttemptResult result = attempt_->attempt(state_, h, next_);
  const bool solved = result.outcome == Outcome::kSuccess;
  solved_ = solved_ || solved;
  blamed_ = solved ? -1 : result.switched;
  if (solved) return result;
  ++counters_.steps_rejected_newton;
  last_rejection_ = "Newton";
  followOrder(1, 0);
  return result;
}

// The strictness of variable order, up to 1e6, is meant for the sum of many smooth steps. At a jump of the rates errors
// fall with h only: held to a millionth of the tolerance, a step over the jump would have to be shorter than time is
// resolved. Strictness alone therefore rejects no step that is hardly longer than that, nor asks for one of less than
// twice that size (which grows with t).
template <class Real>
StepDecision Trajectory<Real>::decide(const AttemptResult& result, double h, double resolved) {
  controller_->factorsCost(jacobian_.factorsCost());
  const bool takes_it = result.too_strict && kShrinkAtMost * h < resolved;
  StepDecision decision = controller_->decide(takes_it ? 1 : result.error, h);
  if (result.too_strict) decision.h = std::max(decision.h, 2 * resolved);
  if (!decision.accept) last_rejection_ = "the error";
  rejected_ = !decision.accept;
  return decision;
}

template <class Real>
double Trajectory<Real>::shorten(double h) {
  attempt_->forget();
  if (++failures_ == 2) solveAlgebraicUnknowns();
  return controller_->afterFailure(h);
}

template <class Real>
void Trajectory<Real>::solveAlgebraicUnknowns() {
  const Sizes scene = constrainedIn(system_).sizes();
  if (scene.nz == scene.constraints || !determined_) return;
  next_ = state_;
  const StartReport report = start_.apply(next_, StartCheck::kNone);
  if (report.outcome == Outcome::kSuccess && report.determined) state_.w.tail(state_.z().size()) = next_.z();
}

template <class Real>
double Trajectory<Real>::nextSize(const AttemptResult& result, double h, double wanted) {
  const NextStep next = attempt_->accepted(result, h, wanted);
  followOrder(next.error, h);
  return next.h;
}

// The controller's exponent has to be that of the next attempt's estimate.
template <class Real>
void Trajectory<Real>::followOrder(double error, double h) {
  if (attempt_->order() == order_) return;
  order_ = attempt_->order();
  controller_->changeOrder(order_, error, h);
}

template <class Real>
Outcome Trajectory<Real>::commit(const AttemptResult& result, const Real& h, const Real& end) {
  const CommittedStep<Real> step = modes_->accept(*attempt_, result, state_, h, next_);
  // The step has to be repeated from the projected state.
  if (step.shortened && isShortAfterLast(step.h) && satisfyConstraints()) return Outcome::kNewtonFailed;
  if (step.outcome != Outcome::kSuccess) {
    blamed_ = step.index;
    return step.outcome;
  }
  if (!step.shortened) next_.t = end;
  if (passesSingularPosition()) return Outcome::kSingular;
  if (leaves_out_) {
    start_detail_ = leftOutViolation(system_, next_, norm_.weights(), allowedDrift(options_.tolerances));
    if (!start_detail_.empty()) return Outcome::kDrift;
  }
  takeOver(step);
  if (!step.at_switch) return completeStep();
  ++counters_.located_events;
  if (chatter_.event(static_cast<double>(state_.t), length_, step.resolution)) {
    ++counters_.chattering;
    blamed_ = step.index;
    return Outcome::kChattering;
  }
  if (!monitor_->located) return restartAtSwitch();
  earlier_ = alongRates(state_, state_, Real(-step.time_error));
  const Outcome outcome = restartAtSwitch();
  if (outcome == Outcome::kSuccess) {
    monitor_->located({step.time_error, system_.toScene(*earlier_), system_.toScene(state_)});
  }
  earlier_.reset();
  return outcome;
}

// Positions that have drifted off their constraints by a tenth of the state tell nothing of a singular position.
template <class Real>
bool Trajectory<Real>::passesSingularPosition() {
  if (!positions_ || !positions_->passes(jacobian_, state_, next_)) return false;
  return constraintViolation(system_, next_, norm_.weights(), kCoarsestDrift / norm_.tolerance()).empty();
}

template <class Real>
Outcome Trajectory<Real>::passTime(Index i) {
  system_.onTime(i, state_);
  system_.jumpAtTime(i, state_);
  return restartAtSwitch();
}

template <class Real>
Outcome Trajectory<Real>::completeStep() {
  if (!system_.completesSteps() || !system_.completeStep(state_)) return Outcome::kSuccess;
  ++counters_.switches;
  tell(-1);
  return restartAtSwitch();
}

template <class Real>
void Trajectory<Real>::takeOver(const CommittedStep<Real>& step) {
  const AttemptResult& attempt = step.attempt;
  std::swap(state_, next_);
  last_h_ = step.h;
  failures_ = 0;
  first_ = false;
  ++counters_.steps_accepted;
  if (controller_) amounts_.look(next_, state_);
  round_off_ = std::max(round_off_, attempt.round_off);
  if (step.switched) {
    ++counters_.switches;
    tell(attempt.switched);
    if (modes_->restarts()) restart();
  }
  if (chatter_.step(step.switched)) noteChattering(attempt.switched);
  if (monitor_->accepted) report(step);
}

// `next_` holds the start of the step.
template <class Real>
void Trajectory<Real>::report(const CommittedStep<Real>& step) {
  const State<Real> scene = system_.toScene(state_);
  const bool inside = monitor_->inside && inside_->begin(next_, state_.t, scene, attempt_->pieces(next_));
  const State<Real>* const errors = attempt_->errors();
  const bool same = errors && errors->u.size() == scene.u.size() && errors->x.size() == scene.x.size();
  monitor_->accepted({state_.t, static_cast<double>(step.h), step.attempt.error, step.attempt.newton_iterations, scene,
                      inside ? &*inside_ : nullptr, same ? errors : nullptr});
}

// Sets the new mode and its (a, k, z), which may make further switches due.
template <class Real>
Outcome Trajectory<Real>::restartAtSwitch() {
  const bool stops = !switches_.none() && system_.discontinuity().at_switch == AtSwitch::kEnd;
  for (int round = 0; round < kSwitchRounds; ++round) {
    const Outcome modes = settle();
    if (modes != Outcome::kSuccess) return modes;
    restart();
    if (projection_ && stops) {
      last_h_ = Real(0);
      const Outcome projected = projection_->applyToPositions(state_);
      if (projected != Outcome::kSuccess) return projected;
    }
    const StartReport report = start_.apply(state_, StartCheck::kNone);
    start_detail_ = report.detail;
    determined_ = report.determined;
    if (report.outcome != Outcome::kSuccess) return report.outcome;
    if (positions_) positions_->restart(state_);
    amounts_.restart(state_);
    if (!report.determined) {
      norm_.update(state_);
      start_detail_ = fixedRowViolation(system_, state_, norm_.weights(), allowedInFixedRows(options_));
      if (!start_detail_.empty()) return Outcome::kInconsistentStart;
    }
    // In index 3 the stages' accelerations are of low order, and their difference at the start shows nothing. If D0 is
    // singular, (a, k) are not known, and the first step may change them: it has no rates to follow.
    if (report.determined && !(projection_ && stops)) attempt_->restart();
    if (switches_.none()) return Outcome::kSuccess;
    const SwitchReport at = switches_.evaluate(state_);
    blamed_ = at.outcome == Outcome::kSuccess ? switches_.dueAt(state_) : at.index;
    if (at.outcome != Outcome::kSuccess || blamed_ < 0) return at.outcome;
  }
  ++counters_.chattering;
  return Outcome::kChattering;
}

// Carries out the switches that are due at the state; counts and reports each.
template <class Real>
Outcome Trajectory<Real>::settle() {
  const SwitchReport report = switches_.settle(state_, Jumps::kDone, [this](Index i) {
    ++counters_.switches;
    if (earlier_) {
      earlier_->d = state_.d;
      system_.jump(i, *earlier_);
    }
    tell(i);
  });
  blamed_ = report.outcome == Outcome::kSuccess ? -1 : report.index;
  return report.outcome;
}

// Forgets the steps before a change of mode, which predict nothing after it.
template <class Real>
void Trajectory<Real>::restart() {
  first_ = true;
  attempt_->forget();
  jacobian_.forget();
  if (controller_) controller_->forget();
}

template <class Real>
void Trajectory<Real>::tell(Index i) const {
  if (!monitor_->switched) return;
  const State<Real> scene = system_.toScene(state_);
  monitor_->switched({state_.t, i, i < 0 ? "step" : system_.switchName(i), scene});
}

template <class Real>
void Trajectory<Real>::noteChattering(Index i) {
  if (++counters_.chattering > 1) return;
  std::ostringstream text;
  text << "chattering: " << switches_.describe(i) << " switches in every step at t = " << sceneTime(system_, state_.t);
  addNote(text.str());
}

template <class Real>
void Trajectory<Real>::addNote(const std::string& text) {
  note_ += (note_.empty() || text.empty() ? "" : "; ") + text;
}

IRK_INSTANTIATE_CLASS(Trajectory)

}  // namespace irk
