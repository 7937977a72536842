#include "core/integration/advance.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "irk/multiprecision.h"

namespace irk {
namespace {

// Of switches at one time that make others due by the (a, k, z) which follow from them.
constexpr int kRounds = 5;

// How finely a switch is located: a part of the tolerance, with fixed steps to round-off.
double locationTolerance(const IntegratorOptions& options) {
  if (options.step.control == StepControl::kFixed) return 0;
  return std::max(options.tolerances.rtol, options.tolerances.atol);
}

}  // namespace

template <class Real>
Advance<Real>::Advance(const System<Real>& system, const Scheme<Real>& scheme,
                       const IntegratorOptions& options, StepAttempt<Real>& attempt,
                       SharedJacobian<Real>& jacobian, ErrorNorm<Real>& norm,
                       StepController* controller, Counters& counters)
    : system_(system),
      start_(system, options.derivatives, scheme.first > 0),
      attempt_(attempt),
      jacobian_(jacobian),
      controller_(controller),
      counters_(counters),
      norm_(norm),
      constraints_(system, norm, options.tolerances),
      switches_(system),
      locator_(system, locationTolerance(options)),
      ends_consistent_(options.multipliers == Multipliers::kConsistent && system.sizes().nz > 0),
      has_tolerance_(options.step.control != StepControl::kFixed),
      locates_(!switches_.none() && system.discontinuity() == Discontinuity::kLocate),
      switches_now_(!locates_ && system.discontinuity() != Discontinuity::kSmooth),
      state_(system.sizes()),
      next_(system.sizes()) {
  const auto& powers = system.errorPowers().v;
  const bool index3 = std::any_of(powers.begin(), powers.end(), [](int p) { return p > 0; });
  if (index3 && locates_) {
    projection_ = std::make_unique<VelocityProjection<Real>>(system, options.derivatives, counters);
  }
}

template <class Real>
Outcome Advance<Real>::begin(const State<Real>& start, double length,
                             const Monitor<Real>& monitor) {
  monitor_ = &monitor;
  length_ = length;
  chatter_ = {};
  start_detail_.clear();
  blamed_ = -1;
  note_.clear();
  round_off_ = 0;
  attempt_.begin();
  jacobian_.forgetPattern();
  restart();
  state_ = system_.fromScene(start);
  const Outcome modes = settle();
  if (modes != Outcome::kSuccess) return modes;
  start_.forgetPattern();
  const StartReport report = start_.apply(state_);
  start_detail_ = report.detail;
  if (!switches_.none() && report.determined) attempt_.restart();
  return report.outcome;
}

template <class Real>
void Advance<Real>::addNote(const std::string& text) {
  note_ += (note_.empty() || text.empty() ? "" : "; ") + text;
}

template <class Real>
Solution<Real> Advance<Real>::solution(Outcome outcome, std::string detail) const {
  return {outcome, std::move(detail), system_.toScene(state_), counters_};
}

template <class Real>
Solution<Real> Advance<Real>::success() {
  if (has_tolerance_) {
    norm_.update(state_);
    const std::string violation = constraints_.violation(state_);
    if (!violation.empty()) return solution(Outcome::kDrift, violation);
  }
  if (ends_consistent_) addNote(start_.applyAtEnd(state_));
  if (round_off_ > 0) {
    std::ostringstream text;
    text.precision(2);
    text << "Newton's corrections end in round-off of the residual, up to " << round_off_
         << " tolerances";
    addNote(text.str());
  }
  return solution(Outcome::kSuccess, note_);
}

template <class Real>
Solution<Real> Advance<Real>::failed(Outcome outcome, double h, const char* what) const {
  if (!start_detail_.empty()) return solution(outcome, start_detail_);
  std::ostringstream text;
  text.precision(6);
  text << what << " at t = " << static_cast<double>(state_.t) << ", h = " << h;
  if (blamed_ >= 0) text << ", " << switches_.describe(blamed_);
  return solution(outcome, text.str());
}

template <class Real>
void Advance<Real>::tell(Index i) const {
  if (!monitor_->switched) return;
  const State<Real> scene = system_.toScene(state_);
  monitor_->switched({state_.t, i, system_.switchName(i), scene});
}

// Due switches at the state, each counted and told.
template <class Real>
Outcome Advance<Real>::settle() {
  if (system_.discontinuity() == Discontinuity::kSmooth) return Outcome::kSuccess;
  const SwitchReport report = switches_.settle(state_, Jumps::kDone, [this](Index i) {
    ++counters_.switches;
    tell(i);
  });
  blamed_ = report.outcome == Outcome::kSuccess ? -1 : report.index;
  return report.outcome;
}

// Nothing of the steps before a change of mode is of use after it.
template <class Real>
void Advance<Real>::restart() {
  attempt_.forget();
  jacobian_.forget();
  if (controller_) controller_->forget();
}

template <class Real>
Outcome Advance<Real>::accept(const AttemptResult& result, const Real& h, const Real& end) {
  if (locates_) return acceptLocated(result, h, end);
  next_.t = end;
  takeOver(result, static_cast<double>(h));
  return Outcome::kSuccess;
}

// In the modes that do not locate, a change of mode has already happened in next_.
template <class Real>
void Advance<Real>::takeOver(const AttemptResult& result, double h) {
  const bool switched = switches_now_ && next_.d != state_.d;
  std::swap(state_, next_);
  ++counters_.steps_accepted;
  round_off_ = std::max(round_off_, result.round_off);
  if (switched) {
    ++counters_.switches;
    tell(result.switched);
    if (system_.discontinuity() == Discontinuity::kIterate) restart();
  }
  if (chatter_.step(switched)) noteChattering(result.switched);
  if (!monitor_->accepted) return;
  const State<Real> scene = system_.toScene(state_);
  monitor_->accepted({state_.t, h, result.error, result.newton_iterations, scene});
}

template <class Real>
void Advance<Real>::noteChattering(Index i) {
  ++counters_.chattering;
  if (counters_.chattering > 1) return;
  std::ostringstream text;
  text << "chattering: " << switches_.describe(i)
       << " switches in every step at t = " << static_cast<double>(state_.t);
  addNote(text.str());
}

// Shortens the solved step to the first switch in it, takes it over, and restarts with the new mode
// and consistent (a, k, z).
template <class Real>
Outcome Advance<Real>::acceptLocated(AttemptResult result, Real h, const Real& end) {
  const Location<Real> at = locator_.locate(attempt_, state_, h, next_);
  if (at.outcome != Outcome::kSuccess) {
    blamed_ = at.index;
    return at.outcome;
  }
  if (at.h < h) {
    // A shorter step with a larger error than the tolerance is no step (NaN: fixed steps).
    if (at.attempt.error > 1) return Outcome::kNewtonFailed;
    result = at.attempt;
    h = at.h;
  } else {
    next_.t = end;
  }
  takeOver(result, static_cast<double>(h));
  if (!at.found) return Outcome::kSuccess;
  ++counters_.located_events;
  if (chatter_.event(static_cast<double>(state_.t), length_, at.resolution)) {
    ++counters_.chattering;
    blamed_ = at.index;
    return Outcome::kChattering;
  }
  return restartAtSwitch();
}

// The new mode and its (a, k, z), which may make further switches due.
template <class Real>
Outcome Advance<Real>::restartAtSwitch() {
  for (int round = 0; round < kRounds; ++round) {
    const Outcome modes = settle();
    if (modes != Outcome::kSuccess) return modes;
    restart();
    if (projection_) {
      const Outcome projected = projection_->applyToPositions(state_);
      if (projected != Outcome::kSuccess) return projected;
    }
    const StartReport report = start_.apply(state_, StartCheck::kNone);
    start_detail_ = report.detail;
    if (report.outcome != Outcome::kSuccess) return report.outcome;
    // In index 3 the stages' accelerations are of low order: what they miss at the start says nothing.
    if (report.determined && !projection_) attempt_.restart();
    const SwitchReport at = switches_.evaluate(state_);
    blamed_ = at.outcome == Outcome::kSuccess ? switches_.due() : at.index;
    if (at.outcome != Outcome::kSuccess || blamed_ < 0) return at.outcome;
  }
  ++counters_.chattering;
  return Outcome::kChattering;
}

IRK_INSTANTIATE_CLASS(Advance)

}  // namespace irk
