#include "experiments/peers/peer_integrator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace irk {
namespace {

// Switches at one time, per switching function, before it is called chattering.
constexpr Index kMostSwitches = 4;

// ODE codes get y' = f(t, y) whatever the scene: without constraints all formulations are one.
SystemOptions systemOptions(const PeerEntry& entry, const RunSpec& spec) {
  const auto formulation =
      entry.differential_algebraic ? spec.formulation : Formulation::kFirstOrder;
  return {formulation, spec.scaling, spec.discontinuity};
}

// The scene's magnitudes; 1 for unknowns that only the formulation has.
Vec<double> absoluteTolerances(const Scene<double>& scene, const Sizes& n, double atol) {
  Vec<double> all = Vec<double>::Constant(n.components(), atol);
  const Index known = std::min(scene.scale.size(), all.size());
  all.head(known) *= scene.scale.head(known).asDiagonal();
  return all;
}

std::unique_ptr<Peer> makePeer(const PeerEntry& entry, const Scene<double>& scene,
                               const RunSpec& spec, const System<double>& system) {
  refuseIllegal(entry, spec, scene.sizes());
  const auto& powers = system.errorPowers().z;
  const auto refuse = [&](std::string_view reason) {
    throw Misuse(fmt::format("illegal combination: method '{}' with scene '{}': {}", entry.id,
                             scene.id, reason));
  };
  if (std::any_of(powers.begin(), powers.end(), [](int p) { return p > 1; })) {
    refuse("it solves up to index 2");
  }
  try {
    (void)system.fromScene(scene.start);
  } catch (const Misuse&) {
    refuse("it solves y' = f(t, y), and the scene's index is above 1: D0 is singular");
  }
  const auto& step = spec.options.step;
  return entry.make(
      {.system = system,
       .rtol = spec.options.tolerances.rtol,
       .atol = absoluteTolerances(scene, system.sizes(), spec.options.tolerances.atol),
       .h = step.h,
       .h_max = step.h_max,
       .derivatives = spec.options.derivatives,
       .locate = spec.discontinuity == Discontinuity::kLocate});
}

}  // namespace

PeerIntegrator::PeerIntegrator(const PeerEntry& entry, const Scene<double>& scene,
                               const RunSpec& spec)
    : system_(scene.system(systemOptions(entry, spec))),
      max_steps_(spec.options.step.max_steps),
      peer_(makePeer(entry, scene, spec, *system_)),
      state_(system_->sizes()),
      g_(system_->sizes().switches) {
  validate(spec.options);
}

Solution<double> PeerIntegrator::integrate(const State<double>& start, double t_end,
                                           const Monitor<double>& monitor) {
  counters_ = {};
  state_ = system_->fromScene(start);
  if (!(state_.t <= t_end)) {
    throw Misuse(fmt::format("t_end = {} lies before the start, t = {}", t_end, state_.t));
  }
  StartReport report = begin(t_end);
  if (report.outcome == Outcome::kSuccess) report = run(t_end, monitor);
  collectCounts();
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
    const StartReport switched = switchModes(t_end, monitor);
    if (switched.outcome != Outcome::kSuccess) return switched;
  }
  return {};
}

StartReport PeerIntegrator::begin(double t_end) {
  const StartReport report = peer_->start(state_, t_end);
  started_ = report.outcome == Outcome::kSuccess;
  return report;
}

// A peer's counts begin anew with each start.
void PeerIntegrator::collectCounts() {
  if (started_) peer_->count(counters_);
  started_ = false;
}

StartReport PeerIntegrator::failed(Outcome outcome, const std::string& what) const {
  return {outcome, fmt::format("{} at t = {:.6g}", what, state_.t)};
}

StartReport PeerIntegrator::switchModes(double t_end, const Monitor<double>& monitor) {
  if (g_.size() == 0 || system_->discontinuity() == Discontinuity::kSmooth) return {};
  Index done = 0;
  for (Index i = dueSwitch(); i >= 0; i = dueSwitch()) {
    if (++done > kMostSwitches * g_.size()) {
      ++counters_.chattering;
      return failed(Outcome::kChattering, system_->switchName(i) + ": switches without end");
    }
    const StartReport report = doSwitch(i, t_end);
    if (report.outcome != Outcome::kSuccess) return report;
    if (monitor.switched) {
      monitor.switched({state_.t, i, system_->switchName(i), system_->toScene(state_)});
    }
  }
  return {};
}

// A switching function that has become positive, or whose root ended the step.
Index PeerIntegrator::dueSwitch() {
  system_->switching(pointOf(state_), {g_.data(), g_.size()});
  for (Index i = 0; i < g_.size(); ++i) {
    if (g_[i] > 0 || peer_->foundRoot(i)) return i;
  }
  return -1;
}

// Located switches begin a new integration. Ignored ones do so only where the state jumps: a jump
// of the rates is left to the error estimate.
StartReport PeerIntegrator::doSwitch(Index i, double t_end) {
  const State<double> before = state_;
  system_->onSwitch(i, state_);
  ++counters_.switches;
  const bool locate = system_->discontinuity() == Discontinuity::kLocate;
  if (locate) ++counters_.located_events;
  const bool jumps = state_.u != before.u || state_.v != before.v || state_.x != before.x;
  if (!locate && !jumps) {
    peer_->setDiscrete(state_.d);
    return {};
  }
  collectCounts();
  // Libraries refuse an interval within round-off of t.
  const double shortest = 100 * std::numeric_limits<double>::epsilon() * std::abs(t_end);
  if (t_end - state_.t <= shortest) state_.t = t_end;
  return begin(t_end);
}

}  // namespace irk
