// Times ensembles: eight systems in lanes, loops of single runs of the same method, and CVODE in a loop, per scene and
// tolerance. `per_member`: CPU time of one thread, integration only.
#include <benchmark/benchmark.h>

#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/base/number_text.h"
#include "experiments/ensembles/ensemble_run.h"
#include "experiments/kernels/benchmark_main.h"
#include "experiments/runs/run.h"
#include "irk/integrator.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

/// A scene with a grid of one axis.
struct Case {
  const char *scene, *parameter, *start;
};
constexpr Case kCases[] = {{"van_der_pol", "eps=1e-6..1e-4:256:log", ""},
                           {"robertson", "", "y2=0..1e-5:256"},
                           {"orego", "", "y2=1..3:256"},
                           {"hires", "", "y8=0.003..0.009:256"},
                           {"kepler", "e=0.1..0.7:256", ""},
                           {"pendulum", "l=0.5..2:256", ""},
                           {"chemakzo", "", "y1=0.3..0.5:256"}};

RunSpec specOf(const Case& c, double tolerance) {
  RunSpec spec;
  spec.scene = c.scene;
  spec.method = "radau_iia_3";
  spec.options = laneOptions({});
  spec.options.tolerances.rtol = spec.options.tolerances.atol = tolerance;
  return spec;
}

Grid gridOf(const Case& c) {
  std::vector<GridAxis> parameters, starts;
  if (*c.parameter) parameters.push_back(gridAxis("--set", c.parameter));
  if (*c.start) starts.push_back(gridAxis("--start", c.start));
  return {parameters, starts};
}

enum class Way { kLanes, kSingle, kBroyden };

void measure(benchmark::State& state, const Case& c, double tolerance, Way way) {
  RunSpec spec = specOf(c, tolerance);
  const EnsembleScene scene(spec, gridOf(c), std::numeric_limits<double>::quiet_NaN());
  const std::size_t size = scene.grid().size();
  std::vector<EnsembleMember> members;
  for (std::size_t i = 0; i < size; ++i) members.push_back(scene.member(i));
  if (way == Way::kBroyden) spec.options.newton.kind = NewtonKind::kBroyden;
  const auto tableau = makeTableau<double>(spec.method);
  std::size_t failures = 0;
  std::int64_t steps = 0;
  const auto count = [&](const Solution<double>& solution) {
    failures += solution.outcome != Outcome::kSuccess;
    steps += solution.counters.steps_accepted;
  };
  if (way == Way::kLanes) {
    Ensemble ensemble = scene.lanes();
    ensemble.member = [&members](std::size_t i) { return members[i]; };
    LaneIntegrator integrator(tableau, spec.options);
    for ([[maybe_unused]] auto _ : state) {
      std::size_t next = 0;
      failures = 0, steps = 0;
      integrator.integrate(
          ensemble, [&] { return next < size ? std::optional(next++) : std::nullopt; },
          [&](std::size_t, const Solution<double>& solution) { count(solution); });
    }
  } else {
    std::vector<Integrator<double>> all;
    for (const auto& m : members) all.emplace_back(m.system, tableau, spec.options, m.scale);
    for ([[maybe_unused]] auto _ : state) {
      failures = 0, steps = 0;
      for (std::size_t i = 0; i < size; ++i) count(all[i].integrate(members[i].start, members[i].t_end));
    }
  }
  state.counters["failures"] = static_cast<double>(failures);
  state.counters["steps"] = static_cast<double>(steps) / static_cast<double>(size);
  state.counters["per_member"] = benchmark::Counter(
      static_cast<double>(size), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// CVODE knows starts only as the scene's own: it is measured over grids of parameters, else at the first member.
void measureCvode(benchmark::State& state, const Case& c, double tolerance) {
  const Grid grid = gridOf(c);
  constexpr std::size_t kEvery = 16;
  std::vector<std::unique_ptr<PreparedRun>> runs;
  for (std::size_t i = 0; i < grid.size(); i += kEvery) {
    RunSpec spec = specOf(c, tolerance);
    spec.options = {};
    spec.options.tolerances.rtol = spec.options.tolerances.atol = tolerance;
    spec.method = "cvode_bdf";
    if (std::string(c.scene) == "pendulum" || std::string(c.scene) == "chemakzo")
      spec.formulation = Formulation::kIndex1;
    if (!grid.parameters().empty()) spec.settings[grid.parameters().front().name] = grid.at(i).front();
    runs.push_back(prepare(spec));
  }
  for ([[maybe_unused]] auto _ : state) {
    for (const auto& run : runs) run->integrate();
  }
  state.counters["per_member"] = benchmark::Counter(
      static_cast<double>(runs.size()), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void addAll() {
  for (const Case& c : kCases) {
    for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
      const auto add = [&](const char* way, auto&&... what) {
        const std::string name = std::string(c.scene) + '/' + numberText(tolerance) + '/' + way;
        benchmark::RegisterBenchmark(name.c_str(), what...)->Unit(benchmark::kMillisecond);
      };
      add("lanes", measure, c, tolerance, Way::kLanes);
      add("single", measure, c, tolerance, Way::kSingle);
      add("single_broyden", measure, c, tolerance, Way::kBroyden);
      add("cvode", measureCvode, c, tolerance);
    }
  }
}

}  // namespace
}  // namespace irk

int main(int argc, char** argv) { return irk::runBenchmarks(argc, argv, "irk_ensembles", irk::addAll); }
