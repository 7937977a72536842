#include "experiments/run.h"

#include "core/integrator.h"
#include "core/multiprecision.h"
#include "experiments/clock.h"
#include "tableaus/catalogue.h"

namespace irk {
namespace {

Vec<double> rounded(const auto& y) {
  return y.unaryExpr([](const auto& value) { return static_cast<double>(value); });
}

template <class Real>
class Prepared final : public PreparedRun {
 public:
  explicit Prepared(const RunSpec& spec)
      : spec_(resolved(spec)),
        scene_(makeScene<Real>(spec_.scene, spec_.settings)),
        references_(references(spec_.scene, spec_.settings)),
        tableau_(makeTableau<Real>(spec_.method)),
        integrator_(scene_.system({spec_.formulation, spec_.scaling, spec_.discontinuity}), tableau_, spec_.options,
                    scene_.scale) {}

  RunRecord execute(const Watch& watch) override {
    Monitor<Real> monitor;
    const double start = threadSeconds();
    const double limit = spec_.time_limit;
    monitor.interrupt = [&watch, start, limit] {
      if (watch.stop && watch.stop->load(std::memory_order_relaxed)) return Outcome::kInterrupted;
      const bool late = limit > 0 && threadSeconds() - start > limit;
      return late ? Outcome::kTimeout : Outcome::kSuccess;
    };
    if (watch.accepted) {
      const double none = std::numeric_limits<double>::quiet_NaN();
      watch.accepted({static_cast<double>(scene_.start.t), none, none, 0, values(scene_.start)});
      monitor.accepted = [&](const StepRecord<Real>& step) {
        watch.accepted({static_cast<double>(step.t), step.h, step.error, step.newton_iterations,
                        values(step.state)});
      };
    }
    if (watch.switched) {
      monitor.switched = [&](const SwitchRecord<Real>& change) {
        watch.switched(static_cast<double>(change.t), change.name);
      };
    }
    const auto solution = integrator_.integrate(scene_.start, Real(spec_.t_end), monitor);
    return record(solution, threadSeconds() - start);
  }

  void integrate() override {
    last_ = integrator_.integrate(scene_.start, Real(spec_.t_end)).outcome;
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
                     .family = tableau_.family,
                     .stages = tableau_.stages(),
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
                     .cpu_s = seconds};
    if (solution.outcome == Outcome::kSuccess) {
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
  Tableau<Real> tableau_;
  Integrator<Real> integrator_;
  Outcome last_ = Outcome::kSuccess;
};

}  // namespace

std::unique_ptr<PreparedRun> prepare(const RunSpec& spec) {
  switch (spec.scalar) {
    case ScalarKind::kDouble:
      return std::make_unique<Prepared<double>>(spec);
    case ScalarKind::kMp50:
      return std::make_unique<Prepared<mp50>>(spec);
  }
  return nullptr;
}

RunRecord execute(const RunSpec& spec, const Watch& watch) { return prepare(spec)->execute(watch); }

RunRecord orRefused(const RunSpec& spec, const std::function<RunRecord()>& make) {
  try {
    return make();
  } catch (const Misuse& misuse) {
    RunRecord record;
    record.spec = spec;
    record.family = spec.method.substr(0, spec.method.rfind('_'));
    record.stages = stagesInId(spec.method);
    record.outcome = "refused";
    record.detail = misuse.what();
    return record;
  }
}

}  // namespace irk
