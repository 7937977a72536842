#include "experiments/runs/peers/peer_integrator.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/derivatives/first_order.h"
#include "core/integration/rules.h"
#include "experiments/runs/peers/problem/make_problem.h"
#include "experiments/runs/setup.h"
#include "irk/system_check.h"

namespace irk {
namespace {

using SystemPointer = std::shared_ptr<const System<double>>;

// The scene as y' = f(t, y), if D0 at acceleration level is regular; else null. `start` gets the scene's start in its
// unknowns.
SystemPointer explicitSystem(const Scene<double>& scene, const RunSpec& spec, State<double>& start) {
  auto system = scene.system({Formulation::kFirstOrder, spec.scaling, spec.discontinuity});
  try {
    start = system->fromScene(scene.start);
    return system;
  } catch (const Misuse&) {
    return nullptr;
  }
}

// ODE codes always get y' = f(t, y): without constraints all formulations are equal. So does a peer that takes a mass
// matrix where no unknown is algebraic.
PeerForm formOf(const PeerEntry& entry, const Scene<double>& scene, const RunSpec& spec, bool determined) {
  if (entry.form != PeerForm::kMass) return entry.form;
  const bool explicit_form = spec.formulation == Formulation::kFirstOrder ||
                             spec.formulation == Formulation::kFirstOrderPerStep || scene.sizes().nz == 0;
  return explicit_form && determined ? PeerForm::kOde : PeerForm::kMass;
}

// The system in the form that the peer takes, and the problem made of it.
std::unique_ptr<SceneProblem> problemOf(const PeerEntry& entry, const Scene<double>& scene, const RunSpec& spec,
                                        SystemPointer& system) {
  refuseIllegal(entry, spec, scene.sizes());
  const auto refuse = [&](std::string_view reason) {
    throw Misuse(fmt::format("illegal combination: method '{}' with scene '{}': {}", entry.id, scene.id, reason));
  };
  State<double> start;
  system = explicitSystem(scene, spec, start);
  const bool determined = system != nullptr;
  if (!determined && !entry.takesConstraints()) {
    refuse("it solves y' = f(t, y), and the scene's index is above 1: D0 is singular");
  }
  const PeerForm form = formOf(entry, scene, spec, determined);
  if (form != PeerForm::kOde) {
    system = scene.system({spec.formulation, spec.scaling, spec.discontinuity});
    start = system->fromScene(scene.start);
  }
  auto problem = makeProblem(
      form, *system, start,
      {spec.options.derivatives, spec.options.storage, determined, toleranceScale(scene, spec, system->sizes())});
  const auto& index = problem->layout().index;
  if (std::any_of(index.begin(), index.end(), [&entry](int i) { return i > entry.max_index; })) {
    refuse(fmt::format("it solves up to index {}", entry.max_index));
  }
  return problem;
}

PeerSetup setupOf(const Scene<double>& scene, const RunSpec& spec, const Sizes& sizes, SceneProblem& problem) {
  const auto& step = spec.options.step;
  const double atol = spec.options.tolerances.atol;
  return {.problem = problem,
          .rtol = spec.options.tolerances.rtol,
          .atol = problem.perComponent(toleranceScale(scene, spec, sizes) * atol, atol),
          .h = step.h,
          .h_max = step.h_max,
          .locate = spec.discontinuity == Discontinuity::kLocate,
          .max_steps = step.max_steps};
}

}  // namespace

PeerIntegrator::PeerIntegrator(const PeerEntry& entry, const Scene<double>& scene, const RunSpec& spec)
    : max_steps_(spec.options.step.max_steps),
      problem_(problemOf(entry, scene, spec, system_)),
      peer_(entry.make(setupOf(scene, spec, system_->sizes(), *problem_))),
      state_(system_->sizes()),
      switches_(*system_),
      derivatives_(spec.options.derivatives),
      ends_consistent_(spec.options.multipliers == Multipliers::kConsistent && system_->sizes().nz > 0) {
  if (!peer_)
    throw Misuse(fmt::format("method '{}' ({}): its function 'make' returned no solver", entry.id, entry.title));
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
  t_end_ = t_end;
  length_ = t_end - state_.t;
  stall_.begin(state_.t);
  StartReport report = settle(monitor);
  if (report.outcome == Outcome::kSuccess) report = run(t_end, monitor);
  if (report.outcome == Outcome::kSuccess && ends_consistent_) {
    report.detail = ConsistentStart<double>(*system_, derivatives_, false).applyAtEnd(state_);
  }
  counters_.mass_factorizations = massFactorizations(*system_);
  return {report.outcome, report.detail, system_->toScene(state_), counters_};
}

// Integrates over the times of the system; at each of them the library starts again.
StartReport PeerIntegrator::run(double t_end, const Monitor<double>& monitor) {
  const auto times = system_->times();
  StartReport report;
  bool new_run = true;
  for (std::size_t i = 0; i < times.size() && report.outcome == Outcome::kSuccess; ++i) {
    if (times[i] <= state_.t || times[i] >= t_end) continue;
    report = runTo(times[i], std::exchange(new_run, false), monitor);
    if (report.outcome != Outcome::kSuccess) break;
    system_->onTime(static_cast<Index>(i), state_);
    system_->jumpAtTime(static_cast<Index>(i), state_);
    report = settle(monitor);
  }
  return report.outcome == Outcome::kSuccess ? runTo(t_end, new_run, monitor) : report;
}

StartReport PeerIntegrator::runTo(double t_end, bool new_run, const Monitor<double>& monitor) {
  StartReport report = mayGoOn(monitor);
  bool goes_on = report.outcome == Outcome::kSuccess;
  while (goes_on) {
    // Libraries refuse an interval that is shorter than round-off of t.
    const double shortest = 100 * std::numeric_limits<double>::epsilon() * std::abs(t_end);
    if (t_end - state_.t <= shortest) state_.t = t_end;
    report = leg(std::exchange(new_run, false), t_end, monitor);
    goes_on = report.outcome == Outcome::kSuccess && restarts_;
  }
  return report;
}

// From the state to the next switch, or to the end.
StartReport PeerIntegrator::leg(bool new_run, double t_end, const Monitor<double>& monitor) {
  restarts_ = false;
  stopped_ = {};
  problem_->resetCounts();
  problem_->setStop([this, &monitor] {
    if (stopped_.outcome == Outcome::kSuccess) stopped_ = mayGoOn(monitor);
    return stopped_.outcome != Outcome::kSuccess;
  });
  StartReport begun = problem_->begin(state_, new_run, values_);
  if (begun.outcome != Outcome::kSuccess || state_.t >= t_end) return begun;
  const double* const yp = values_.yp.size() > 0 ? values_.yp.data() : nullptr;
  const Outcome outcome = peer_->integrate({state_.t, values_.y.data(), yp, new_run}, t_end,
                                           [&](const PeerStep& step) { return accepted(step, t_end, monitor); });
  peer_->count(counters_);
  problem_->count(counters_);
  problem_->setStop({});
  if (stopped_.outcome != Outcome::kSuccess || restarts_) return stopped_;
  const std::string reason = peer_->message();
  if (outcome != Outcome::kSuccess) return failed(outcome, reason.empty() ? "the method gave up" : reason);
  return state_.t >= t_end ? StartReport{} : failed(Outcome::kStepTooSmall, "the method returned before the end");
}

// After most steps nothing has to be told: reports, which hold a text, are kept only if they end the run.
PeerNext PeerIntegrator::accepted(const PeerStep& step, double t_end, const Monitor<double>& monitor) {
  const auto goes_on = [this](StartReport report) {
    if (report.outcome == Outcome::kSuccess) return true;
    stopped_ = std::move(report);
    return false;
  };
  if (stopped_.outcome != Outcome::kSuccess || restarts_) return PeerNext::kReturn;
  if (!goes_on(take(step, t_end, monitor)) || restarts_ || state_.t >= t_end) return PeerNext::kReturn;
  return goes_on(mayGoOn(monitor)) ? PeerNext::kContinue : PeerNext::kReturn;
}

StartReport PeerIntegrator::take(const PeerStep& step, double t_end, const Monitor<double>& monitor) {
  if (!(step.t >= state_.t && step.t <= t_end)) {
    return failed(Outcome::kNotFinite, fmt::format("the method reports a step to {:.17g}, which is not in the interval "
                                                   "up to {:.17g},",
                                                   step.t, t_end));
  }
  if (!ConstVec<double>(step.y, problem_->layout().n).allFinite()) {
    return failed(Outcome::kNotFinite, "the method reports a state that is not finite");
  }
  const double t = state_.t;
  problem_->read(step, state_);
  ++counters_.steps_accepted;
  if (monitor.accepted) {
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    monitor.accepted({state_.t, state_.t - t, kUnknown, 0, system_->toScene(state_)});
  }
  if (stall_.attempted(state_.t, t_end_, max_steps_ - counters_.steps_accepted)) {
    return failed(Outcome::kStalled, fmt::format("steps do not grow ({} accepted, {} switches)",
                                                 counters_.steps_accepted, counters_.switches));
  }
  StartReport report;
  if (switches()) {
    const bool locate = system_->discontinuity() == Discontinuity::kLocate;
    report = locate ? locatedSwitch(step, monitor) : ignoredSwitches(monitor);
  }
  if (report.outcome == Outcome::kSuccess && !restarts_) completeStep(monitor);
  return report;
}

// A step may itself ask for another mode.
void PeerIntegrator::completeStep(const Monitor<double>& monitor) {
  if (!system_->completesSteps() || !system_->completeStep(state_)) return;
  ++counters_.switches;
  tell(-1, monitor);
  restarts_ = true;
}

StartReport PeerIntegrator::mayGoOn(const Monitor<double>& monitor) const {
  const Outcome caller = monitor.interrupt ? monitor.interrupt() : Outcome::kSuccess;
  if (caller != Outcome::kSuccess) return failed(caller, "stopped");
  if (counters_.steps_accepted == max_steps_) return failed(Outcome::kMaxSteps, "steps used up");
  return {};
}

StartReport PeerIntegrator::failed(Outcome outcome, const std::string& what) const {
  return {outcome, fmt::format("{} at t = {:.6g}", what, state_.t)};
}

void PeerIntegrator::tell(Index i, const Monitor<double>& monitor) const {
  if (!monitor.switched) return;
  const auto scene = system_->toScene(state_);
  monitor.switched({state_.t, i, i < 0 ? "step" : system_->switchName(i), scene});
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

// Carries out one switch, the one whose root ended the step or else one that is due, and restarts. Other switches that
// become due by it wait for the next step: the library interpolates the state at a root, so that functions that should
// be 0 there can be positive by round-off.
StartReport PeerIntegrator::locatedSwitch(const PeerStep& step, const Monitor<double>& monitor) {
  const SwitchReport report = switches_.evaluate(state_);
  if (report.outcome != Outcome::kSuccess) {
    return failed(report.outcome, switches_.describe(report.index));
  }
  Index i = 0;
  while (i < switches_.g().size() && !(step.roots && step.roots[i] != 0)) ++i;
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
  restarts_ = true;
  return {};
}

// Restarts only if the state jumps. Jumps of derivatives are left to the error estimate.
StartReport PeerIntegrator::ignoredSwitches(const Monitor<double>& monitor) {
  const State<double> before = state_;
  StartReport report = settle(monitor);
  if (report.outcome != Outcome::kSuccess) return report;
  if (chatter_.step(state_.d != before.d)) ++counters_.chattering;
  const bool jumped = state_.u != before.u || state_.v != before.v || state_.x != before.x;
  restarts_ = jumped;
  problem_->setDiscrete(state_.d);
  return {};
}

}  // namespace irk
