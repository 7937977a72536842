#include "experiments/run.h"

#include <algorithm>

#include "core/integrator.h"
#include "core/multiprecision.h"
#include "core/variable_order.h"
#include "experiments/clock.h"
#include "experiments/decimal.h"
#include "experiments/peers/peer_integrator.h"
#include "tableaus/catalogue.h"

namespace irk {
namespace {

Vec<double> rounded(const auto& y) {
  return y.unaryExpr([](const auto& value) { return static_cast<double>(value); });
}

/// An implicit Runge-Kutta method of the suite.
template <class Real>
class RungeKutta {
 public:
  RungeKutta(const Scene<Real>& scene, const RunSpec& spec)
      : methods_(methodsOf(spec)),
        stages_(isFamily(spec.method) ? 0 : methods_.members[methods_.start].stages()),
        system_(scene.system({spec.formulation, spec.scaling, spec.discontinuity})),
        integrator_(system_, methods_, spec.options, systemScale(scene.scale, system_->sizes())) {}

  const std::string& family() const { return methods_.members.front().family; }
  Index stages() const { return stages_; }
  Solution<Real> integrate(const State<Real>& start, const Real& t_end,
                           const Monitor<Real>& monitor) {
    auto solution = integrator_.integrate(start, t_end, monitor);
    const auto* form = dynamic_cast<const FirstOrderForm<Real>*>(system_.get());
    if (form && solution.detail.empty()) {
      solution.detail = "mass factorizations: " + std::to_string(form->massFactorizations());
    }
    return solution;
  }

 private:
  static Methods<Real> methodsOf(const RunSpec& spec) {
    refuseFamilyOfFixedOrder(spec);
    if (spec.options.order == OrderControl::kFixed) return makeTableau<Real>(spec.method);
    return makeMethods<Real>(spec.method, spec.max_stages, firstStages(spec.options.tolerances));
  }

  Methods<Real> methods_;
  Index stages_;  // 0: a family's, by the tolerance
  std::shared_ptr<const System<Real>> system_;
  Integrator<Real> integrator_;
};

/// An integrator of another library.
class PeerMethod {
 public:
  PeerMethod(const Scene<double>& scene, const RunSpec& spec)
      : entry_(*findPeer(spec.method)), integrator_(entry_, scene, spec) {}

  const std::string& family() const { return entry_.id; }
  Index stages() const { return 0; }
  Solution<double> integrate(const State<double>& start, double t_end,
                             const Monitor<double>& monitor) {
    return integrator_.integrate(start, t_end, monitor);
  }

 private:
  const PeerEntry& entry_;
  PeerIntegrator integrator_;
};

// Asked before each step: whether the caller or the time limit ends a run that began at `start`.
std::function<Outcome()> interruption(const Watch& watch, double start, double limit) {
  return [&watch, start, limit] {
    if (watch.stop && watch.stop->load(std::memory_order_relaxed)) return Outcome::kInterrupted;
    const bool late = limit > 0 && threadSeconds() - start > limit;
    return late ? Outcome::kTimeout : Outcome::kSuccess;
  };
}

template <class Real, class Method>
class Prepared final : public PreparedRun {
 public:
  explicit Prepared(const RunSpec& spec)
      : spec_(resolved(spec)),
        scene_(makeScene<Real>(spec_.scene, settingsAtStep(spec_))),
        references_(references(spec_.scene, settingsAtStep(spec_))),
        method_(scene_, spec_) {}

  RunRecord execute(const Watch& watch) override {
    Monitor<Real> monitor;
    const double start = threadSeconds();
    monitor.interrupt = interruption(watch, start, spec_.time_limit);
    if (watch.accepted) {
      const double none = std::numeric_limits<double>::quiet_NaN();
      watch.accepted({static_cast<double>(scene_.start.t), none, none, 0, values(scene_.start)});
      monitor.accepted = [&](const StepRecord<Real>& step) {
        watch.accepted({static_cast<double>(step.t), step.h, step.error, step.newton_iterations,
                        values(step.state)});
      };
    }
    std::vector<SwitchEvent> switches;
    monitor.switched = [&](const SwitchRecord<Real>& change) {
      const double t = static_cast<double>(change.t);
      if (switches.size() < kMostRecordedSwitches) switches.push_back({t, change.name});
      if (watch.switched) watch.switched(t, change.name);
    };
    const auto t_end = decimalNumber<Real>(spec_.t_end);
    const auto solution = method_.integrate(scene_.start, t_end, monitor);
    RunRecord result = record(solution, threadSeconds() - start);
    result.switches = std::move(switches);
    return result;
  }

  void integrate() override {
    last_ = method_.integrate(scene_.start, decimalNumber<Real>(spec_.t_end), {}).outcome;
  }

  std::vector<std::string> columns() const override {
    auto names = scene_.names;
    for (const auto& output : scene_.outputs) names.push_back(output.name);
    return names;
  }

 private:
  std::vector<double> values(const State<Real>& state) const {
    std::vector<double> all;
    const auto append = [&all](const Vec<double>& y) { all.insert(all.end(), y.begin(), y.end()); };
    append(rounded(state.u));
    append(rounded(state.v));
    append(rounded(state.x));
    append(rounded(state.z()));
    for (const auto& output : scene_.outputs) {
      all.push_back(static_cast<double>(output.value(state)));
    }
    return all;
  }

  RunRecord record(const Solution<Real>& solution, double seconds) const {
    const State<Real>& state = solution.state;
    RunRecord record{.spec = spec_,
                     .family = method_.family(),
                     .stages = method_.stages(),
                     .outcome = std::string(name(solution.outcome)),
                     .detail = solution.detail,
                     .t = static_cast<double>(state.t),
                     .u = rounded(state.u),
                     .v = rounded(state.v),
                     .x = rounded(state.x),
                     .z = rounded(state.z()),
                     .digits = {},
                     .errors = {},
                     .counters = solution.counters,
                     .switches = {},
                     .cpu_s = seconds};
    // A state that violates its constraints is a final state as well: its error tells by how much.
    if (solution.outcome == Outcome::kSuccess || solution.outcome == Outcome::kDrift) {
      record.errors = errorsOf(scene_, references_, state);
    }
    if constexpr (!std::is_same_v<Real, double>) {
      const auto append = [&record](const auto& y) {
        for (const Real& value : y) record.digits.push_back(value.str());
      };
      append(state.u);
      append(state.v);
      append(state.x);
      append(state.z());
    }
    return record;
  }

  RunSpec spec_;
  Scene<Real> scene_;
  std::vector<Reference> references_;
  Method method_;
  Outcome last_ = Outcome::kSuccess;
};

// A setting `X/h` has a value only where the step is the same throughout.
void requireKnownStep(const RunSpec& spec) {
  if (spec.options.step.control == StepControl::kFixed) return;
  for (const auto& [name, value] : spec.settings) {
    if (value.ends_with("/h")) {
      throw Misuse(name + " = '" + value + "': a value over h needs fixed steps, --step H");
    }
  }
}

}  // namespace

Vec<double> systemScale(const Vec<double>& scene, const Sizes& system) {
  Vec<double> all = Vec<double>::Ones(system.components());
  const Index known = std::min(scene.size(), all.size());
  all.head(known) = scene.head(known);
  return all;
}

std::unique_ptr<PreparedRun> prepare(const RunSpec& spec) {
  requireKnownStep(spec);
  if (findPeer(spec.method)) return std::make_unique<Prepared<double, PeerMethod>>(spec);
  switch (spec.scalar) {
    case ScalarKind::kDouble:
      return std::make_unique<Prepared<double, RungeKutta<double>>>(spec);
    case ScalarKind::kMp50:
      return std::make_unique<Prepared<mp50, RungeKutta<mp50>>>(spec);
    case ScalarKind::kMp100:
      return std::make_unique<Prepared<mp100, RungeKutta<mp100>>>(spec);
  }
  return nullptr;
}

RunRecord execute(const RunSpec& spec, const Watch& watch) { return prepare(spec)->execute(watch); }

FinalState integrateFrom(const RunSpec& spec, const State<double>& start, const Watch& watch) {
  const RunSpec whole = resolved(spec);
  if (findPeer(whole.method)) throw Misuse("integrateFrom: '" + whole.method + "' is a peer");
  const auto scene = makeScene<double>(whole.scene, settingsAtStep(whole));
  RungeKutta<double> method(scene, whole);
  Monitor<double> monitor;
  monitor.interrupt = interruption(watch, threadSeconds(), whole.time_limit);
  auto solution = method.integrate(start, whole.t_end, monitor);
  return {solution.outcome, std::move(solution.detail), std::move(solution.state)};
}

RunRecord orRefused(const RunSpec& spec, const std::function<RunRecord()>& make) {
  try {
    return make();
  } catch (const Misuse& misuse) {
    RunRecord record;
    record.spec = spec;
    const bool peer = findPeer(spec.method) != nullptr;
    const bool whole = peer || isFamily(spec.method);
    record.family = whole ? spec.method : spec.method.substr(0, spec.method.rfind('_'));
    record.stages = stagesInId(spec.method);
    record.outcome = "refused";
    record.detail = misuse.what();
    return record;
  }
}

}  // namespace irk
