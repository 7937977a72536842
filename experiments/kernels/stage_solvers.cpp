// Times the parts of a step at the start of a scene, per scene, stage solver, number of stages and number of
// unknowns: residual, Jacobian, factorization, solve, Newton iteration, whole step.
#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "core/steps/stepper.h"
#include "experiments/analyses/newton_kernel.h"
#include "experiments/kernels/benchmark_main.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

// Beyond these sizes one dense factorization takes seconds.
constexpr int kMaxDense = 400, kMaxCoupledDense = 1500;

RunSpec specOf(const SceneEntry& chain, StageSolverKind solver, Storage storage, const benchmark::State& state) {
  RunSpec spec;
  spec.scene = chain.id;
  spec.settings = {{chain.size.parameter, std::to_string(state.range(1) / chain.size.unknowns)}};
  spec.method = "radau_iia_" + std::to_string(state.range(0));
  spec.options.solver = solver;
  spec.options.storage = storage;
  spec.options.threads = static_cast<int>(state.range(2));
  spec.options.tolerances.rtol = spec.options.tolerances.atol = 1e-6;
  return spec;
}

struct Part {
  const char* name;
  void (NewtonKernel::*call)();
};
constexpr Part kSystemParts[] = {{"residuals", &NewtonKernel::residuals}, {"jacobian", &NewtonKernel::jacobian}};
constexpr Part kSolverParts[] = {
    {"factorize", &NewtonKernel::factorize}, {"solve", &NewtonKernel::solve}, {"iteration", &NewtonKernel::iteration}};

void measurePart(benchmark::State& state, const SceneEntry& chain, StageSolverKind solver, Storage storage,
                 const Part& part) {
  NewtonKernel kernel(specOf(chain, solver, storage, state), chain.size.step);
  kernel.factorize();
  for ([[maybe_unused]] auto _ : state) (kernel.*part.call)();
  state.counters["n"] = static_cast<double>(kernel.unknowns());
  state.counters["entries"] = static_cast<double>(kernel.nonzeros());
  state.counters["directions"] = static_cast<double>(kernel.directions());
}

/// One step from the scene's start, with a new Jacobian.
void measureStep(benchmark::State& state, const SceneEntry& chain, StageSolverKind solver, Storage storage) {
  const RunSpec spec = specOf(chain, solver, storage, state);
  const auto setup = makeSetup<double>(spec);
  const auto& scene = setup.scene;
  const auto& system = setup.system;
  const Scheme<double> scheme(setup.methods.members.front());
  Counters counters;
  ErrorNorm<double> norm(*system, spec.options.tolerances, scene.scale);
  SharedJacobian<double> jacobian(*system, scheme, spec.options, counters);
  Stepper<double> stepper(*system, scheme, spec.options, jacobian, norm, counters);
  State<double> end(system->sizes());
  norm.update(scene.start);
  const auto step = [&] {
    stepper.forget();
    jacobian.markStale();
    return stepper.attempt(stepper.stages(), scene.start, chain.size.step, end).outcome;
  };
  if (step() != Outcome::kSuccess) return state.SkipWithError("the step is not solved");
  const std::int64_t before = counters.newton_iterations;
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(step());
  state.counters["n"] = static_cast<double>(system->sizes().n());
  state.counters["iterations_per_step"] =
      static_cast<double>(counters.newton_iterations - before) / static_cast<double>(state.iterations());
}

template <class... What>
void add(const std::string& name, bool dense, bool coupled, const std::vector<std::int64_t>& threads, What... what) {
  auto* entry = benchmark::RegisterBenchmark(name.c_str(), what...);
  entry->ArgNames({"stages", "n", "threads"})->Unit(benchmark::kMicrosecond);
  for (const std::int64_t s : {3, 5, 8, 10}) {
    for (const std::int64_t n : {12, 24, 100, 200, 400, 1000, 2000, 4000}) {
      if (dense && (n > kMaxDense || (coupled && s * n > kMaxCoupledDense))) continue;
      for (const std::int64_t t : threads) entry->Args({s, n, t});
    }
  }
  if (threads.size() > 1) entry->UseRealTime();
}

void addAll() {
  constexpr struct {
    StageSolverKind kind;
    Storage storage;
  } kSolvers[] = {
      {StageSolverKind::kSchur, Storage::kSparse},         {StageSolverKind::kEigen, Storage::kSparse},
      {StageSolverKind::kCoupledSparse, Storage::kSparse}, {StageSolverKind::kSchur, Storage::kDense},
      {StageSolverKind::kEigen, Storage::kDense},          {StageSolverKind::kCoupledDense, Storage::kDense}};
  for (const SceneEntry& chain : sceneCatalogue()) {
    if (chain.size.parameter.empty()) continue;
    const std::string scene = chain.id + '/';
    for (const Part& part : kSystemParts) {
      add(scene + part.name, false, false, {1}, measurePart, chain, StageSolverKind::kSchur, Storage::kSparse, part);
    }
    for (const auto& [kind, storage] : kSolvers) {
      const bool dense = storage == Storage::kDense, coupled = kind == StageSolverKind::kCoupledDense;
      const std::string solver = scene + std::string(idOf(kind)) + '/' + std::string(idOf(storage)) + '/';
      for (const Part& part : kSolverParts) {
        add(solver + part.name, dense, coupled, {1}, measurePart, chain, kind, storage, part);
      }
      add(solver + "step", dense, coupled, {1}, measureStep, chain, kind, storage);
      if (kind == StageSolverKind::kSchur) {
        add(solver + "factorize_parallel", dense, false, {1, 2}, measurePart, chain, kind, storage, kSolverParts[0]);
      }
    }
  }
}

}  // namespace
}  // namespace irk

int main(int argc, char** argv) { return irk::runBenchmarks(argc, argv, "irk_kernels", irk::addAll); }
