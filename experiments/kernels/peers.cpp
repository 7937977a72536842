// Times the adapters of other libraries' integrators beside direct calls of the same libraries, on van der Pol's
// equation, where an evaluation costs next to nothing. Before it measures, it checks that both take the same steps.
//   evaluation/WHAT/...    one evaluation of the equation, of its Jacobian
//   setup/CODE/adapter     what the adapter makes before it integrates
//   call/CODE/...          a whole integration, the library's set-up and the adapter's included
// CODE: cvode, ida; euler, a cheap function with the calling sequence of RADAU (fortran_codes.c); evaluations, a
// function with that calling sequence that evaluates only; and radau, the code itself, if IRK_RADAU names a library
// with it.
// `.ci/peers` keeps the ratios below a bar.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>

#include "experiments/kernels/direct_calls.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/peers/loaded/adapters.h"
#include "experiments/runs/peers/peer_integrator.h"
#include "experiments/runs/peers/problem/make_problem.h"
#include "experiments/runs/setup.h"
#include "irk/misuse.h"

namespace irk {
namespace {

// A whole call, directly and by the adapter.
struct Call {
  std::string name;
  std::function<direct::Result()> direct;
  std::function<direct::Result()> adapter;
  std::function<void()> setup;
};

// What `irk` times as a run of a peer: makes the integrator and integrates.
direct::Result adapterCall(const PeerEntry& entry, const Scene<double>& scene, const RunSpec& spec) {
  PeerIntegrator integrator(entry, scene, spec);
  const auto solution = integrator.integrate(scene.start, spec.t_end);
  if (solution.outcome != Outcome::kSuccess) throw Misuse(entry.id + ": " + solution.detail);
  return {{solution.state.x[0], solution.state.x[1]}, solution.counters.steps_accepted, solution.counters.residuals};
}

Call callOf(const std::string& name, const PeerEntry& entry, const std::string& settings,
            const std::function<direct::Result()>& direct) {
  const RunSpec spec = resolved(parseSpec("scene=van_der_pol;method=cvode_bdf;" + settings));
  const auto scene = makeScene<double>("van_der_pol");
  return {name, direct, [entry, scene, spec] { return adapterCall(entry, scene, spec); },
          [entry, scene, spec] { PeerIntegrator(entry, scene, spec); }};
}

// The codes with RADAU's calling sequence. `rtol` and `atol` are 1e-6, as those of the libraries.
std::vector<Call> fortranCalls() {
  constexpr double kTol = 1e-6;
  std::vector<Call> calls;
  const auto add = [&](const std::string& name, const std::string& path, const char* code, double t_end, double h,
                       int steps) {
    const auto library = std::make_shared<const SharedLibrary>(path);
    auto* const function = library->get<void()>((std::string(code) + '_').c_str());
    const std::string settings = "rtol=1e-6;atol=1e-6;h=" + std::to_string(h) + ";t_end=" + std::to_string(t_end) +
                                 ";max_steps=" + std::to_string(steps);
    calls.push_back(callOf(name, hairerPeer(library, code), settings,
                           [=] { return direct::radau(function, t_end, kTol, h, 2 * steps); }));
  };
  add("euler", IRK_FORTRAN_CODES, "radau", 0.5, 1e-4, 100'000);
  add("evaluations", IRK_FORTRAN_CODES, "radau5", 0.5, 1e-4, 50'000);
  if (const char* const radau = std::getenv("IRK_RADAU")) add("radau", radau, "radau", 2, 0, 100'000);
  return calls;
}

std::vector<Call> allCalls() {
  constexpr double kEnd = 2;
  std::vector<Call> calls = fortranCalls();
  for (const auto& [tol, text] : {std::pair(1e-4, "1e-4"), std::pair(1e-6, "1e-6"), std::pair(1e-8, "1e-8")}) {
    const std::string settings = std::string("t_end=2;rtol=") + text + ";atol=" + text;
    const double given = tol;
    calls.push_back(callOf(std::string("cvode/") + text, *findPeer("cvode_bdf"), settings,
                           [given] { return direct::cvode(kEnd, given); }));
    calls.push_back(callOf(std::string("ida/") + text, *findPeer("ida_bdf"), settings,
                           [given] { return direct::ida(kEnd, given); }));
  }
  return calls;
}

// The last digits of evaluations by hand are others, and van der Pol's equation makes much of them: the numbers of
// steps differ by up to a tenth. So times are compared per evaluation.
void requireEqual(const Call& call) {
  constexpr double kDifference = 1e-2;
  const direct::Result direct = call.direct(), adapter = call.adapter();
  const double distance = std::abs(direct.y[0] - adapter.y[0]);
  const auto far = [](std::int64_t a, std::int64_t b) { return 5 * std::abs(a - b) > a; };
  if (distance > kDifference || far(direct.steps, adapter.steps) || far(direct.evaluations, adapter.evaluations)) {
    throw Misuse(call.name + ": the direct call takes " + std::to_string(direct.steps) + " steps and " +
                 std::to_string(direct.evaluations) + " evaluations to y1 = " + std::to_string(direct.y[0]) +
                 ", the adapter " + std::to_string(adapter.steps) + ", " + std::to_string(adapter.evaluations) + ", " +
                 std::to_string(adapter.y[0]));
  }
}

void measure(benchmark::State& state, const std::function<direct::Result()>& call) {
  direct::Result result{};
  for ([[maybe_unused]] auto _ : state) benchmark::DoNotOptimize(result = call());
  const auto evaluations = static_cast<double>(result.evaluations);
  state.counters["evaluations"] = evaluations;
  using benchmark::Counter;
  state.counters["per_evaluation"] = Counter(evaluations, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

// The scene as a peer gets it.
struct Problem {
  Scene<double> scene = makeScene<double>("van_der_pol");
  std::shared_ptr<const System<double>> system;
  std::unique_ptr<SceneProblem> problem;
  PeerValues values;
  PeerJacobian J;

  explicit Problem(PeerForm form)
      : system(scene.system({form == PeerForm::kOde ? Formulation::kFirstOrder : Formulation::kIndex2})) {
    State<double> start = system->fromScene(scene.start);
    problem = makeProblem(form, *system, start, {});
    static_cast<void>(problem->begin(start, true, values));
  }
};

using Evaluation = void (*)(const double* y, double* to);

void measureDirect(benchmark::State& state, Evaluation evaluation) {
  Vec<double> y{{2, -0.66}}, to(4);
  benchmark::DoNotOptimize(evaluation);  // called by its address, as libraries do
  for ([[maybe_unused]] auto _ : state) {
    evaluation(y.data(), to.data());
    benchmark::ClobberMemory();
  }
}

template <class Evaluate>
void measureAdapter(benchmark::State& state, PeerForm form, const Evaluate& evaluate) {
  Problem at(form);
  Vec<double> to(2);
  for ([[maybe_unused]] auto _ : state) {
    if (evaluate(at, to) != Evaluated::kDone) state.SkipWithError("the scene cannot be evaluated");
    benchmark::ClobberMemory();
  }
}

void addEvaluations() {
  const auto add = [](const std::string& name, const auto&... what) {
    benchmark::RegisterBenchmark(("evaluation/" + name).c_str(), what...);
  };
  add("rates/direct", measureDirect, [](const double* y, double* to) { direct::rates(0, y, to); });
  add("jacobian/direct", measureDirect, [](const double* y, double* to) { direct::jacobian(0, y, to); });
  add("rates/adapter", [](benchmark::State& state) {
    measureAdapter(state, PeerForm::kOde,
                   [](Problem& at, Vec<double>& to) { return at.problem->rates(0, at.values.y.data(), to.data()); });
  });
  add("residual/adapter", [](benchmark::State& state) {
    measureAdapter(state, PeerForm::kDae, [](Problem& at, Vec<double>& to) {
      return at.problem->residual(0, at.values.y.data(), at.values.yp.data(), to.data());
    });
  });
  for (const bool ode : {true, false}) {
    add(ode ? "jacobian/adapter" : "residual_jacobian/adapter", [ode](benchmark::State& state) {
      measureAdapter(state, ode ? PeerForm::kOde : PeerForm::kDae, [](Problem& at, Vec<double>&) {
        return at.problem->jacobian(0, at.values.y.data(), at.values.yp.data(), 3, at.J, nullptr);
      });
    });
  }
}

void addAll() {
  addEvaluations();
  for (const Call& call : allCalls()) {
    requireEqual(call);
    const auto add = [&](const char* way, const std::function<direct::Result()>& made) {
      benchmark::RegisterBenchmark(("call/" + call.name + way).c_str(), measure, made)->Unit(benchmark::kMicrosecond);
    };
    add("/direct", call.direct);
    add("/adapter", call.adapter);
    const auto setup = [made = call.setup](benchmark::State& state) {
      for ([[maybe_unused]] auto _ : state) made();
    };
    benchmark::RegisterBenchmark(("setup/" + call.name + "/adapter").c_str(), setup);
  }
}

}  // namespace
}  // namespace irk

int main(int argc, char** argv) try {
  irk::addAll();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
} catch (const irk::Misuse& misuse) {
  std::fprintf(stderr, "irk_peers: %s\n", misuse.what());
  return 2;
}
