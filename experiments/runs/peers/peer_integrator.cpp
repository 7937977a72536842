#include "experiments/runs/peers/peer_integrator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/integration/rules.h"
#include "experiments/runs/setup.h"
#include "irk/system_check.h"

namespace irk {
namespace {

// ODE codes always get y' = f(t, y): without constraints all formulations are equal.
SystemOptions systemOptions(const PeerEntry& entry, const RunSpec& spec) {
  const auto formulation = entry.differential_algebraic ? spec.formulation : Formulation::kFirstOrder;
  return {formulation, spec.scaling, spec.discontinuity};
}

// Whether D0 at acceleration level is regular, so that y' = f(t, y) exists.
bool isDetermined(const Scene<double>& scene, SystemOptions options) {
  options.formulation = Formulation::kFirstOrder;
  try {
    (void)scene.system(options)->fromScene(scene.start);
    return true;
  } catch (const Misuse&) {
    return false;
  }
}

std::unique_ptr<Peer> makePeer(const PeerEntry& entry, const Scene<double>& scene, const RunSpec& spec,
                               const System<double>& system) {
  refuseIllegal(entry, spec, scene.sizes());
  const auto refuse = [&](std::string_view reason) {
    throw Misuse(fmt::format("illegal combination: method '{}' with scene '{}': {}", entry.id, scene.id, reason));
  };
  const auto& powers = system.errorPowers().z;
  if (std::any_of(powers.begin(), powers.end(), [](int p) { return p > 1; })) {
    refuse("it solves up to index 2");
  }
  const bool determined = isDetermined(scene, systemOptions(entry, spec));
  if (!determined && !entry.differential_algebraic) {
    refuse("it solves y' = f(t, y), and the scene's index is above 1: D0 is singular");
  }
  const auto& step = spec.options.step;
  return entry.make({.system = system,
                     .rtol = spec.options.tolerances.rtol,
                     .atol = systemScale(scene.scale, system.sizes()) * spec.options.tolerances.atol,
                     .h = step.h,
                     .h_max = step.h_max,
                     .derivatives = spec.options.derivatives,
                     .determined = determined,
                     .locate = spec.discontinuity == Discontinuity::kLocate});
}

}  // namespace

PeerIntegrator::PeerIntegrator(const PeerEntry& entry, const Scene<double>& scene, const RunSpec& spec)
    : system_(scene.system(systemOptions(entry, spec))),
      max_steps_(spec.options.step.max_steps),
      peer_(makePeer(entry, scene, spec, *system_)),
      state_(system_->sizes()),
      switches_(*system_),
      derivatives_(spec.options.derivatives),
      ends_consistent_(spec.options.multipliers == Multipliers::kConsistent && system_->sizes().nz > 0) {
  validate(spec.options);
  requireLegal(spec.options);
}

Solution<double> PeerIntegrator::integrate(const State<double>& start, double t_end, const Monitor<double>& monitor) {
  counters_ = {};
  chatter_ = {};
  requireStart(*system_, start, t_end);
  const std::string not_finite = notFinite(start);
  if (!not_finite.empty()) return {Outcome::kNotFinite, "at the start: " + not_finite, start, counters_};
  state_ = system_->fromScene(start);
  length_ = t_end - state_.t;
  StartReport report = settle(monitor);
  if (report.outcome == Outcome::kSuccess) report = begin(t_end, StartCheck::kConstraints);
  if (report.outcome == Outcome::kSuccess) report = run(t_end, monitor);
  collectCounts();
  if (report.outcome == Outcome::kSuccess && ends_consistent_) {
    report.detail = ConsistentStart<double>(*system_, derivatives_, false).applyAtEnd(state_);
  }
  return {report.outcome, report.detail, system_->toScene(state_), counters_};
}

StartReport PeerIntegrator::run(double t_end, const Monitor<double>& monitor) {
  while (state_.t < t_end) {
    const Outcome caller = monitor.interrupt ? monitor.interrupt() : Outcome::kSuccess;
    if (caller != Outcome::kSuccess) return failed(caller, "stopped");
    if (counters_.steps_accepted == max_steps_) return failed(Outcome::kMaxSteps, "steps used up");
    const double t = state_.t;
    const Outcome outcome = peer_->step(state_);
    if (outcome != Outcome::kSuccess) return failed(outcome, peer_->message());
    ++counters_.steps_accepted;
    if (monitor.accepted) {
      constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
      monitor.accepted({state_.t, state_.t - t, kUnknown, 0, system_->toScene(state_)});
    }
    const StartReport switched = afterStep(t_end, monitor);
    if (switched.outcome != Outcome::kSuccess) return switched;
  }
  return {};
}

StartReport PeerIntegrator::begin(double t_end, StartCheck check) {
  collectCounts();
  // Libraries refuse an interval that is shorter than round-off of t.
  const double shortest = 100 * std::numeric_limits<double>::epsilon() * std::abs(t_end);
  if (t_end - state_.t <= shortest) state_.t = t_end;
  const StartReport report = peer_->start(state_, t_end, check);
  started_ = report.outcome == Outcome::kSuccess;
  return report;
}

// A peer resets its counts at each start, so they are added here before.
void PeerIntegrator::collectCounts() {
  if (started_) peer_->count(counters_);
  started_ = false;
}

StartReport PeerIntegrator::failed(Outcome outcome, const std::string& what) const {
  return {outcome, fmt::format("{} at t = {:.6g}", what, state_.t)};
}

void PeerIntegrator::tell(Index i, const Monitor<double>& monitor) const {
  if (!monitor.switched) return;
  const auto scene = system_->toScene(state_);
  monitor.switched({state_.t, i, system_->switchName(i), scene});
}

bool PeerIntegrator::switches() const {
  return !switches_.none() && system_->discontinuity() != Discontinuity::kSmooth;
}

StartReport PeerIntegrator::settle(const Monitor<double>& monitor) {
  if (!switches()) return {};
  const SwitchReport report = switches_.settle(state_, Jumps::kDone, [&](Index i) {
    ++counters_.switches;
    tell(i, monitor);
  });
  if (report.outcome == Outcome::kSuccess) return {};
  return failed(report.outcome, switches_.describe(report.index));
}

StartReport PeerIntegrator::afterStep(double t_end, const Monitor<double>& monitor) {
  if (!switches()) return {};
  const bool locate = system_->discontinuity() == Discontinuity::kLocate;
  return locate ? locatedSwitch(t_end, monitor) : ignoredSwitches(t_end, monitor);
}

// Performs one switch, the one whose root ended the step or else one that is due, and restarts. Switches that become
// due by this one wait for the next step: the library interpolates the state at a root, so that by round-off
// functions that should be 0 there can be positive.
StartReport PeerIntegrator::locatedSwitch(double t_end, const Monitor<double>& monitor) {
  const SwitchReport report = switches_.evaluate(state_);
  if (report.outcome != Outcome::kSuccess) {
    return failed(report.outcome, switches_.describe(report.index));
  }
  Index i = 0;
  while (i < switches_.g().size() && !peer_->foundRoot(i)) ++i;
  if (i == switches_.g().size()) i = switches_.due();
  if (i < 0) return {};
  ++counters_.located_events;
  if (chatter_.event(state_.t, length_, 0)) {
    ++counters_.chattering;
    return failed(Outcome::kChattering, switches_.describe(i));
  }
  system_->onSwitch(i, state_);
  system_->jump(i, state_);
  ++counters_.switches;
  tell(i, monitor);
  return begin(t_end, StartCheck::kNone);
}

// Restarts only if the state jumps; jumps of the derivatives are left to the error estimate.
StartReport PeerIntegrator::ignoredSwitches(double t_end, const Monitor<double>& monitor) {
  const State<double> before = state_;
  const StartReport report = settle(monitor);
  if (report.outcome != Outcome::kSuccess) return report;
  if (chatter_.step(state_.d != before.d)) ++counters_.chattering;
  const bool jumped = state_.u != before.u || state_.v != before.v || state_.x != before.x;
  if (jumped) return begin(t_end, StartCheck::kNone);
  peer_->setDiscrete(state_.d);
  return {};
}

}  // namespace irk
