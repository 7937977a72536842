#include "experiments/runs/run.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <system_error>

#include "core/options/fixed_steps.h"
#include "experiments/base/clock.h"
#include "experiments/base/decimal.h"
#include "experiments/base/failure.h"
#include "experiments/own/crash.h"
#include "experiments/own/stuck.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/own_files.h"
#include "experiments/runs/run_method.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

Vec<double> rounded(const auto& y) {
  return y.unaryExpr([](const auto& value) { return static_cast<double>(value); });
}

// In which a thread works while it makes the run.
int digitsOf(const RunSpec& spec) { return spec.scalar.isDouble() ? WorkingDigits::now() : spec.scalar.digits; }

// Returns a function that is called before each step. It tells whether the caller or the time limit ends the run, which
// began at `start`.
std::function<Outcome()> interruption(const Watch& watch, double start, double limit) {
  return [&watch, start, limit] {
    own::stillGoing(limit);
    for (const auto* stop : {watch.stop, watch.cancelled}) {
      if (stop && stop->load(std::memory_order_relaxed)) return Outcome::kInterrupted;
    }
    const bool late = limit > 0 && threadSeconds() - start > limit;
    return late ? Outcome::kTimeout : Outcome::kSuccess;
  };
}

template <class Real, class Method>
class Prepared final : public PreparedRun {
 public:
  Prepared(const RunSpec& spec, const own::FixedText* crash)
      : method_(spec),
        spec_(method_.spec()),
        scene_(method_.scene()),
        references_(references(spec_.scene, settingsAtStep(spec_))),
        crash_(crash) {}

  RunRecord execute(const Watch& watch) override {
    const own::Running running(crash_);
    const WorkingDigits digits(digitsOf(spec_));
    Monitor<Real> monitor;
    const double start = threadSeconds();
    monitor.interrupt = interruption(watch, start, spec_.time_limit);
    auto invariants = watch.invariants ? invariantsAtStart() : std::vector<Followed>{};
    if (!invariants.empty()) {
      monitor.accepted = [&](const StepRecord<Real>& step) { follow(step.state, invariants); };
    }
    if (watch.accepted) {
      const double none = std::numeric_limits<double>::quiet_NaN();
      watch.accepted({static_cast<double>(scene_.start.t), none, none, 0, values(scene_.start)});
      monitor.inside = watch.inside;
      monitor.accepted = [&](const StepRecord<Real>& step) {
        follow(step.state, invariants);
        Inside inside(*this, step.inside);
        watch.accepted({static_cast<double>(step.t), step.h, step.error, step.newton_iterations, values(step.state),
                        step.inside ? &inside : nullptr});
      };
    }
    std::vector<SwitchEvent> switches;
    monitor.switched = [&](const SwitchRecord<Real>& change) {
      const double t = static_cast<double>(change.t);
      if (switches.size() < kMaxRecordedSwitches) switches.push_back({t, change.name});
      if (watch.switched) watch.switched(t, change.name, values(change.state));
    };
    const auto t_end = decimalNumber<Real>(spec_.t_end);
    auto solution = method_.integrate(scene_.start, t_end, monitor);
    const double seconds = threadSeconds() - start;
    const MeasuringWatch measuring{interruption(watch, threadSeconds(), spec_.time_limit), watch.measuring};
    auto bar = measuredErrorBar(spec_, scene_, solution, measuring);
    RunRecord result = record(solution, seconds, watch);
    result.error_bar = std::move(bar);
    result.switches = std::move(switches);
    for (auto& one : invariants) result.invariants.push_back(std::move(one.change));
    if (result.succeeded()) addErrorsOverTime(watch, result);
    const std::string doubt = result.succeeded() ? doubtOf(result.error_bar, spec_) : "";
    if (!doubt.empty()) {
      result.outcome = name(Outcome::kInaccurate);
      result.detail = doubt;
    }
    return result;
  }

  void integrate() override {
    const own::Running running(crash_);
    const WorkingDigits digits(digitsOf(spec_));
    last_ = method_.integrate(scene_.start, decimalNumber<Real>(spec_.t_end), {}).outcome;
  }

  void setUp() override {
    const own::Running running(crash_);
    const WorkingDigits digits(digitsOf(spec_));
    (void)method_.newIntegrator();
  }

  void wholeCall() override {
    const own::Running running(crash_);
    const WorkingDigits digits(digitsOf(spec_));
    auto integrator = method_.newIntegrator();
    last_ = integrator.integrate(scene_.start, decimalNumber<Real>(spec_.t_end), {}).outcome;
  }

  void startFrom(const Settings& components) override {
    const WorkingDigits digits(digitsOf(spec_));
    scene_.start = startWith(method_.scene(), components);
    scene_.exact = {};
    references_.clear();
  }

  std::vector<std::string> columns() const override {
    auto names = scene_.names;
    for (const auto& output : scene_.outputs) names.push_back(output.name);
    return names;
  }

 private:
  struct Followed {
    const typename Scene<Real>::Output* output;
    Real start;
    InvariantChange change;
  };
  std::vector<Followed> invariantsAtStart() const {
    std::vector<Followed> all;
    for (const auto& output : scene_.outputs) {
      if (output.invariant) {
        const Real start = output.value(scene_.start);
        all.push_back({&output, start, {output.name, output.unit, static_cast<double>(start), 0}});
      }
    }
    return all;
  }
  static void follow(const State<Real>& state, std::vector<Followed>& invariants) {
    for (auto& [output, start, change] : invariants) {
      const double distance = std::abs(static_cast<double>(Real(output->value(state) - start)));
      if (!(distance <= change.change)) change.change = distance;
    }
  }

  class Inside final : public ValuesInside {
   public:
    Inside(const Prepared& run, InsideStep<Real>* step) : run_(run), step_(step) {}
    std::vector<double> at(double t) override { return run_.values(step_->at(Real(t))); }

   private:
    const Prepared& run_;
    InsideStep<Real>* step_;
  };

  std::vector<double> values(const State<Real>& state) const {
    const Vec<double> y = rounded(components(state));
    std::vector<double> all(y.begin(), y.end());
    for (const auto& output : scene_.outputs) {
      all.push_back(static_cast<double>(output.value(state)));
    }
    return all;
  }

  // Constant steps have no tolerances.
  ToleranceRatio toleranceRatio() const {
    const Tolerances& tolerances = spec_.options.tolerances;
    if (hasFixedSteps(spec_.options.step) || tolerances.rtol == 0) return {};
    return {tolerances.atol / tolerances.rtol, toleranceScale(scene_, spec_, scene_.sizes())};
  }

  // The errors of a state; `spec` is the spec of a run to the state's time.
  RunErrors errorsAt(const State<Real>& state, RunSpec spec, const Watch& watch) const {
    const ToleranceRatio ratio = toleranceRatio();
    const double t = static_cast<double>(state.t);
    const bool makes = watch.reference && needsReference(spec = endingAt(spec, t));
    // At a switch a state is compared with that of another run at its own time of the switch, and with nothing else.
    if (!makes && !spec.options.stop_at.empty()) return errorsByComputed(scene_, {}, state, ratio);
    if (!makes) return errorsOf(scene_, references_, state, ratio);
    MadeReference made = watch.reference(spec);
    for (auto& value : made.values) value.t = t;
    RunErrors errors = errorsByComputed(scene_, made.values, state, ratio);
    if (errors.reference == ReferenceKind::kNone) errors.remark = made.problem;
    return errors;
  }

  // Sets the largest errors over the reference times: those of `record`, a success, and those of the runs to the
  // earlier times. A run to an earlier time takes the same steps up to there.
  void addErrorsOverTime(const Watch& watch, RunRecord& record) {
    record.errors_over_time = record.errors;
    auto runs = atReferenceTimes(spec_);
    runs.pop_back();
    for (const auto& run : runs) {
      Monitor<Real> monitor;
      monitor.interrupt = interruption(watch, threadSeconds(), spec_.time_limit);
      const auto solution = method_.integrate(scene_.start, decimalNumber<Real>(run.t_end), monitor);
      const bool success = solution.outcome == Outcome::kSuccess;
      if (solution.outcome == Outcome::kInterrupted) record.outcome = name(Outcome::kInterrupted);
      record.errors_over_time =
          largerErrors(record.errors_over_time, success ? errorsAt(solution.state, run, watch) : RunErrors{});
      if (!success) return;
    }
  }

  RunRecord record(const Solution<Real>& solution, double seconds, const Watch& watch) const {
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
                     .counters = solution.counters,
                     .cpu_s = seconds};
    // A state that violates its constraints is a final state as well: its error shows how large the violation is.
    if (solution.outcome == Outcome::kSuccess || solution.outcome == Outcome::kDrift) {
      record.errors = errorsAt(state, spec_, watch);
    }
    if constexpr (!std::is_same_v<Real, double>) {
      for (const Real& value : components(state)) record.digits.push_back(value.str());
    }
    return record;
  }

  Method method_;
  const RunSpec& spec_;
  Scene<Real> scene_;  // that of the method, with the start of the run
  std::vector<Reference> references_;
  const own::FixedText* crash_;  // what a crash of the run's own code prints
  Outcome last_ = Outcome::kSuccess;
};

// A setting `X/h` has a value only if the step is constant.
void requireKnownStep(const RunSpec& spec) {
  if (hasFixedSteps(spec.options.step)) return;
  for (const auto& [name, value] : spec.settings) {
    if (value.ends_with("/h")) {
      throw Misuse(name + " = '" + value + "': a value over h needs fixed steps, --step H");
    }
  }
}

}  // namespace

std::unique_ptr<PreparedRun> prepare(const RunSpec& spec) {
  validate(spec);
  requireKnownStep(spec);
  own::stillGoing(spec.time_limit);
  const own::FixedText* const crash = own::Running::messageOf(codeOf(spec));
  const own::Running running(crash);
  if (findPeer(spec.method)) return std::make_unique<Prepared<double, PeerMethod>>(spec, crash);
  const WorkingDigits digits(digitsOf(spec));
  if (spec.scalar.isDouble()) return std::make_unique<Prepared<double, RungeKutta<double>>>(spec, crash);
  return std::make_unique<Prepared<BigFloat, RungeKutta<BigFloat>>>(spec, crash);
}

RunRecord execute(const RunSpec& spec, const Watch& watch) { return prepare(spec)->execute(watch); }

Solution<double> integrateFrom(const RunSpec& spec, const State<double>& start, const Watch& watch) {
  RungeKutta<double> method(spec);
  Monitor<double> monitor;
  monitor.interrupt = interruption(watch, threadSeconds(), method.spec().time_limit);
  return method.integrate(start, method.spec().t_end, monitor);
}

namespace {

// The row of a run that was not integrated to an outcome.
RunRecord rowOf(const RunSpec& spec, const char* outcome, const std::string& detail) {
  RunRecord record;
  record.spec = spec;
  const bool whole = findPeer(spec.method) || isFamily(spec.method);
  record.family = whole ? spec.method : spec.method.substr(0, spec.method.rfind('_'));
  record.stages = stagesInId(spec.method);
  record.outcome = outcome;
  record.detail = detail;
  return record;
}

// The row of a run whose own code has thrown. Call it where the exception is caught: one of the program goes on.
RunRecord thrown(const RunSpec& spec, const std::string& what) {
  const std::string code = codeOf(spec);
  if (code.empty()) throw;
  return rowOf(spec, "exception", code + " throws: " + what);
}

}  // namespace

RunRecord asRow(const RunSpec& spec, const std::function<RunRecord()>& make) {
  try {
    return make();
  } catch (const Misuse& misuse) {
    return rowOf(spec, "refused", misuse.what());
  } catch (const Failure&) {
    throw;
  } catch (const std::system_error&) {  // of files that the program writes
    throw;
  } catch (const std::bad_alloc&) {
    return thrown(spec, "out of memory");
  } catch (const std::exception& error) {
    return thrown(spec, error.what());
  } catch (...) {
    return thrown(spec, "an exception without text");
  }
}

}  // namespace irk
