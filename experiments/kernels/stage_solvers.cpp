// One factorization and one solve of the Newton matrix, per stage solver and number of stages, at
// n = 98 to 100: the ANCF pendulum with 24 elements at its start.
#include <benchmark/benchmark.h>

#include <cstdio>
#include <string>
#include <vector>

#include "core/scheme.h"
#include "core/stage_solver.h"
#include "problems/scene.h"
#include "tableaus/catalogue.h"

namespace irk {
namespace {

constexpr double kStep = 1e-3;  // s: about what an accurate run takes

struct Kernel {
  std::vector<Linearization<double>> at;
  std::unique_ptr<StageSolver<double>> solver;
  Mat<double> rhs;

  Kernel(StageSolverKind kind, Index stages) {
    const auto scene = makeScene<double>("ancf_pendulum", {{"elements", "24"}});
    const auto system = scene.system({});
    const Sizes n = system->sizes();
    at.emplace_back(Pattern::dense(n.n()));
    const auto& start = scene.start;
    const auto view = [](const auto& y) { return ConstVec<double>(y.data(), y.size()); };
    const Vec<double> a = start.a(), k = start.k(), z = start.z();
    Differentiator<double>(*system, DerivativeSource::kAutomatic)
        .evaluate(Level::kFormulated,
                  {start.t, view(start.u), view(start.v), view(start.x), view(a), view(k), view(z)},
                  at.front());
    const Scheme<double> scheme(makeTableau<double>("radau_iia_" + std::to_string(stages)));
    solver = makeStageSolver<double>(
        kind, {scheme.implicitA(), at.front().pattern, system->rowPowers(), n});
    if (solver->stagewise()) at.resize(static_cast<std::size_t>(stages), at.front());
    rhs = Mat<double>::Ones(n.n(), stages);
  }
};

void factorizeAndSolve(benchmark::State& state, StageSolverKind kind) {
  Kernel kernel(kind, state.range(0));
  Mat<double> rhs = kernel.rhs;
  for ([[maybe_unused]] auto _ : state) {
    const Outcome outcome = kernel.solver->factorize(kernel.at, kStep);
    if (outcome != Outcome::kSuccess) {
      state.SkipWithError("factorization failed");
      break;
    }
    rhs = kernel.rhs;
    kernel.solver->solve(rhs);
    benchmark::DoNotOptimize(rhs.data());
  }
  state.counters["n"] = static_cast<double>(rhs.rows());
}

}  // namespace
}  // namespace irk

int main(int argc, char** argv) {
  try {
    for (const auto& solver : irk::named<irk::StageSolverKind>()) {
      benchmark::RegisterBenchmark(std::string(solver.id).c_str(), irk::factorizeAndSolve,
                                   solver.value)
          ->Arg(3)
          ->Arg(5)
          ->Arg(10)
          ->ArgName("stages")
          ->Unit(benchmark::kMicrosecond);
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
