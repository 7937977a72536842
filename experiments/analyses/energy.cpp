#include "experiments/analyses/energy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/options/fixed_steps.h"
#include "experiments/analyses/line_fit.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/run_table.h"
#include "experiments/runs/setup.h"
#include "experiments/study/analysis.h"

namespace irk {
namespace {

constexpr double kEnergySamples = 2000;

struct EnergyErrors {
  std::vector<double> t, error;
};

const Scene<BigFloat>::Output* energyOf(const Scene<BigFloat>& scene) {
  const auto found = std::find_if(scene.outputs.begin(), scene.outputs.end(),
                                  [](const auto& output) { return output.name == "energy"; });
  return found == scene.outputs.end() ? nullptr : &*found;
}

// The exact value of the state: its numbers plus the carries of compensated summation.
State<BigFloat> exactly(const State<double>& state) {
  State<BigFloat> s;
  s.t = state.t;
  s.u = state.u.cast<BigFloat>();
  s.v = state.v.cast<BigFloat>();
  s.x = state.x.cast<BigFloat>();
  s.w = state.w.cast<BigFloat>();
  s.d = state.d.cast<BigFloat>();
  const Index nu = s.u.size();
  s.u += state.carry.head(nu).cast<BigFloat>();
  s.v += state.carry.segment(nu, nu).cast<BigFloat>();
  s.x += state.carry.tail(s.x.size()).cast<BigFloat>();
  return s;
}

EnergyErrors integrate(const RunSpec& spec, const Scene<BigFloat>::Output& energy) {
  const auto setup = makeSetup<double>(spec);
  const BigFloat start = energy.value(exactly(setup.scene.start));
  const auto stride =
      static_cast<std::int64_t>(std::max(1.0, std::round(setup.spec.t_end / spec.options.step.h / kEnergySamples)));
  EnergyErrors errors;
  std::int64_t steps = 0;
  Monitor<double> monitor;
  monitor.accepted = [&](const StepRecord<double>& step) {
    if (++steps % stride != 0) return;
    errors.t.push_back(step.t);
    const BigFloat error = energy.value(exactly(step.state)) - start;
    errors.error.push_back(static_cast<double>(error));
  };
  monitor.interrupt = [] { return interruptFlag() ? Outcome::kInterrupted : Outcome::kSuccess; };
  auto integrator = setup.integrator();
  const auto solution = integrator.integrate(setup.scene.start, setup.spec.t_end, monitor);
  return solution.outcome == Outcome::kSuccess ? errors : EnergyErrors{};
}

}  // namespace

EnergyDrift energyDrift(const std::vector<double>& t, const std::vector<double>& error) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  if (t.size() < 3) return {kUnknown, kUnknown, kUnknown};
  const LineFit fit = fitLine(t, error);
  EnergyDrift result{fit.slope, std::sqrt(fit.sum_of_squares / static_cast<double>(t.size())), 0};
  for (const double e : error) result.largest = std::max(result.largest, std::abs(e));
  return result;
}

void writeEnergy(const Study& study, const RunFile& runs, const std::filesystem::path& file) {
  const Table& names = runs.names();
  auto columns = seriesColumns(names);
  columns.insert(columns.end(), {"h", "t", "energy_error", "drift", "scatter", "largest"});
  TableWriter table(file, names.head, columns);
  repeatRuns(study, runs, nullptr, [&](const RunSeries& series, const TableRow&, const RunSpec& spec) {
    const auto scene = sceneOf<BigFloat>(spec);
    const auto* energy = energyOf(scene);
    if (!energy || !hasFixedSteps(spec.options.step)) return;
    const EnergyErrors errors = integrate(spec, *energy);
    const EnergyDrift drift = energyDrift(errors.t, errors.error);
    for (std::size_t i = 0; i < errors.t.size(); ++i) {
      TableRow row = series.name;
      for (const double x :
           {spec.options.step.h, errors.t[i], errors.error[i], drift.drift, drift.scatter, drift.largest}) {
        row.push_back(numberText(x));
      }
      table.add(row);
    }
  });
  table.close();
}

Analysis energyAnalysis() {
  return {.key = "energy",
          .meaning = "what round-off does to an energy over many steps",
          .writes = "energy.csv",
          .run = [](const AnalysisInput& in) { writeEnergy(in.study, in.runs, in.folder / "energy.csv"); }};
}

}  // namespace irk
