// The parts of Newton's method, per stage solver, number of stages and number of unknowns:
// residual, Jacobian, factorization and solve of the ANCF pendulum at its start.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <string>

#include "experiments/newton_kernel.h"

namespace irk {
namespace {

constexpr double kStep = 1e-3;  // s: about what an accurate run takes

NewtonKernel makeKernel(StageSolverKind solver, const benchmark::State& state) {
  RunSpec spec;
  spec.scene = "ancf_pendulum";
  spec.settings = {{"elements", std::to_string(state.range(1))}};
  spec.method = "radau_iia_" + std::to_string(state.range(0));
  spec.options.solver = solver;
  return {spec, kStep};
}

struct Part {
  const char* name;
  void (NewtonKernel::*call)();
};
constexpr Part kSystemParts[] = {{"residual", &NewtonKernel::residual},
                                 {"jacobian", &NewtonKernel::jacobian}};
constexpr Part kSolverParts[] = {{"factorize", &NewtonKernel::factorize},
                                 {"solve", &NewtonKernel::solve}};

void measure(benchmark::State& state, StageSolverKind solver, const Part& part) {
  NewtonKernel kernel = makeKernel(solver, state);
  kernel.factorize();
  for ([[maybe_unused]] auto _ : state) (kernel.*part.call)();
  state.counters["n"] = static_cast<double>(kernel.unknowns());
}

void add(const std::string& name, StageSolverKind solver, const Part& part) {
  benchmark::RegisterBenchmark(name.c_str(), measure, solver, part)
      ->ArgsProduct({{3, 5, 10}, {4, 24}})
      ->ArgNames({"stages", "elements"})
      ->Unit(benchmark::kMicrosecond);
}

}  // namespace
}  // namespace irk

int main(int argc, char** argv) {
  try {
    for (const auto& part : irk::kSystemParts) {
      irk::add(part.name, irk::StageSolverKind::kSchur, part);
    }
    for (const auto& solver : irk::named<irk::StageSolverKind>()) {
      for (const auto& part : irk::kSolverParts) {
        irk::add(std::string(solver.id) + '/' + part.name, solver.value, part);
      }
    }
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
    benchmark::RunSpecifiedBenchmarks();
  } catch (const irk::Misuse& misuse) {
    std::fprintf(stderr, "irk_kernels: %s\n", misuse.what());
    return 2;
  }
  return 0;
}
