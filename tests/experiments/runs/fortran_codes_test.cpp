// The calling sequences of Fortran codes, with a stand-in for the user's library: tests/solvers/fortran_like.c.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <thread>

#include "experiments/own/shared_library.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/peers/catalogue.h"
#include "experiments/runs/peers/loaded/load_method.h"
#include "experiments/runs/peers/peer_integrator.h"
#include "experiments/runs/run.h"
#include "experiments/study/study_reader.h"
#include "tests/experiments/heat.h"
#include "tests/experiments/runs/peer_runs.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

constexpr const char* kLibrary = IRK_SOLVERS "/fortran_like.so";
constexpr const char* kHairer[] = {"radau", "radau5", "rodas", "seulex"};
const std::vector<std::string> kAll{"radau", "radau5", "rodas", "seulex", "ddassl", "ddaspk"};

std::string at(const std::string& code) { return code + "@" + kLibrary; }

// As in fortran_like.c.
enum Seen { kBanded, kLower, kUpper, kM1, kMass, kMassBanded, kIndex2, kIndex3, kCalls };
int seen(Seen what) {
  static const SharedLibrary library(kLibrary);
  return library.get<int>("standin_seen")[what];
}

RunSpec spec(const std::string& code, const std::string& rest, double tol = 1e-5) {
  return peerSpec(at(code), rest, tol);
}

TEST(FortranCodes, FollowTheTolerance) {
  for (const auto& code : kAll) {
    double coarser = 1;
    for (const double tol : {1e-3, 1e-5}) {
      const RunRecord run = peerSuccess(spec(code, "scene=riccati_tracking", tol));
      EXPECT_EQ(run.spec.method, code);
      EXPECT_LT(run.errors.all, 1000 * tol) << code;
      EXPECT_LT(run.errors.all, 0.1 * coarser) << code;
      coarser = run.errors.all;
      EXPECT_GT(run.counters.jacobians, 0) << code;
      EXPECT_GT(run.counters.factorizations, 0) << code;
    }
    EXPECT_EQ(seen(kMass), 0) << code;
    EXPECT_EQ(findPeer(code)->source.size(), 16U);
  }
}

// y = (u, v): the rows u' = v are left to the code, and both blocks of the others are banded.
TEST(FortranCodes, UseTheStructureOfSecondOrderSystems) {
  const std::string rest = "scene=beam_chain;settings=m=25;t_end=0.01";
  const RunRecord exact = peerSuccess(parseSpec("method=radau_iia_5;rtol=1e-9;atol=1e-9;" + rest));
  for (const std::string code : kHairer) {
    const int calls = seen(kCalls);
    const RunRecord run = peerSuccess(spec(code, rest));
    EXPECT_EQ(seen(kCalls), calls + 1) << code;  // no entry was outside the band
    EXPECT_EQ(seen(kM1), 25) << code;
    EXPECT_EQ(seen(kBanded), 1) << code;
    EXPECT_EQ(seen(kLower), 2) << code;
    EXPECT_EQ(seen(kUpper), 2) << code;
    EXPECT_LT((run.u - exact.u).norm(), 1e-3 * exact.u.norm()) << code;
    peerSuccess(spec(code, "scene=kepler;t_end=1"));
    EXPECT_EQ(seen(kM1), 2) << code;
    EXPECT_EQ(seen(kBanded), 0) << code;
  }
}

TEST(FortranCodes, GetBandedJacobians) {
  const auto scene = heatScene();
  for (const auto& code : kAll) {
    const auto end = [&](const char* storage, int banded) {
      const RunSpec run = spec(code, std::string("scene=kepler;storage=") + storage);
      PeerIntegrator integrator(*findPeer(code), scene, run);
      const auto solution = integrator.integrate(scene.start, 0.1);
      EXPECT_EQ(solution.outcome, Outcome::kSuccess) << code << " " << solution.detail;
      EXPECT_EQ(seen(kBanded), banded) << code;
      return solution.state.x;
    };
    const Vec<double> band = end("automatic", 1);
    EXPECT_EQ(seen(kLower), 1) << code;
    EXPECT_EQ(seen(kUpper), 1) << code;
    const Vec<double> dense = end("dense", 0);
    EXPECT_LT((band - dense).norm(), 1e-10) << code;
    EXPECT_GT(band.norm(), 0.1) << code;
  }
}

// pendulum: constant mass; slider_crank: accelerations become unknowns; index1_nonlinear: first-order unknowns.
TEST(FortranCodes, GetAMassMatrixWhereUnknownsAreAlgebraic) {
  for (const char* rest : {"scene=pendulum;t_end=0.5;formulation=index1",
                           "scene=slider_crank;t_end=0.05;formulation=index1", "scene=index1_nonlinear"}) {
    const RunRecord exact = peerSuccess(parseSpec(std::string("method=radau_iia_5;rtol=1e-10;atol=1e-10;") + rest));
    for (const auto& code : kAll) {
      const RunRecord run = peerSuccess(spec(code, rest));
      const bool dassl = code.starts_with("dd");
      EXPECT_EQ(seen(kMass), dassl ? 0 : 1) << code << " " << rest;
      const auto near = [&](const Vec<double>& a, const Vec<double>& b) {
        EXPECT_LT((a - b).norm(), 1e-2 * (1e-3 + b.norm())) << code << " " << rest;
      };
      near(run.u, exact.u);
      near(run.v, exact.v);
      near(run.x, exact.x);
    }
  }
}

TEST(FortranCodes, GetTheIndexOfTheirUnknowns) {
  for (const char* code : {"radau", "radau5"}) {
    peerSuccess(spec(code, "scene=pendulum;t_end=0.2;formulation=index1"));
    EXPECT_EQ(seen(kIndex2), 0) << code;
    peerSuccess(spec(code, "scene=pendulum;t_end=0.2;formulation=index2"));
    EXPECT_EQ(seen(kIndex2), 1) << code;
    EXPECT_EQ(seen(kIndex3), 0) << code;
    static_cast<void>(execute(spec(code, "scene=pendulum;t_end=0.01;formulation=index3")));
    EXPECT_EQ(seen(kIndex3), 1) << code;
  }
}

// irk run work_precision --peers radau@...,rodas@...: RADAU solves index 2, as ida_bdf does, RODAS does not.
TEST(FortranCodes, TakePartInAStudyThatDoesNotNameThem) {
  const auto study = loadStudy("work_precision", StudyVariant::kQuick, {at("radau"), at("rodas")});
  std::map<std::string, std::set<std::string>> blocks;
  for (const auto& series : study.series) blocks[series.runs[0].method].insert(series.block);
  EXPECT_EQ(blocks["radau"], blocks["ida_bdf"]);
  EXPECT_EQ(blocks["rodas"], blocks["cvode_bdf"]);
  EXPECT_EQ(blocks["radau"].size(), 4u) << "one for each collection";
  const auto refused = [](const char* id, const std::vector<std::string>& peers) {
    return misuseOf([&] { loadStudy(id, StudyVariant::kQuick, peers); });
  };
  EXPECT_TRUE(containsAll(refused("work_precision", {"gauss_3"}), {"--peers", "'gauss_3'", "CODE@PATH.so"}));
  EXPECT_TRUE(containsAll(refused("work_precision", {at("radau"), at("radau")}), {"--peers", "'radau' twice"}));
  EXPECT_TRUE(containsAll(refused("order", {at("radau")}), {"--peers", "'radau'", "'ida_bdf'", "no block"}));
}

// The codes of a library share COMMON blocks: no two of them run at the same time.
TEST(FortranCodes, OfOneLibraryRunOneAtATime) {
  std::vector<RunSpec> runs;
  for (const char* code : {"radau5", "rodas"}) runs.push_back(spec(code, "scene=riccati_tracking", 1e-4));
  std::vector<std::thread> threads;
  for (const auto& run : runs) {
    threads.emplace_back([&run] {
      for (int i = 0; i < 20; ++i) EXPECT_TRUE(execute(run).succeeded());
    });
  }
  for (auto& thread : threads) thread.join();
  EXPECT_EQ(*SharedLibrary(kLibrary).get<int>("standin_overlaps"), 0);
}

TEST(FortranCodes, UnsupportedRunsAreRefused) {
  const auto refusal = [](const std::string& code, const std::string& rest) {
    return misuseOf([&] { prepare(spec(code, rest)); });
  };
  for (const auto& code : kAll) {
    EXPECT_TRUE(containsAll(refusal(code, "scene=stick_slip;discontinuity=locate"), {code, "locate"}));
    EXPECT_TRUE(containsAll(refusal(code, "scene=kepler;control=fixed;h=0.1"), {code, "fixed"}));
  }
  for (const std::string code : {"rodas", "seulex", "ddassl", "ddaspk"}) {
    EXPECT_TRUE(containsAll(refusal(code, "scene=pendulum"), {code, "index2", "index1"}));
    EXPECT_TRUE(containsAll(refusal(code, "scene=index2_nonlinear"), {code, "index 1"}));
  }
  EXPECT_TRUE(containsAll(misuseOf([] { loadMethod(at("radua5")); }), {"radua5", "radau5", "ddassl"}));
  EXPECT_TRUE(
      containsAll(misuseOf([] { loadMethod("radau@" IRK_SOLVERS "/euler_ode.so"); }), {"euler_ode.so", "radau_"}));
}

TEST(FortranCodes, LimitsAndInterruptsEndARun) {
  for (const auto& code : kAll) {
    RunSpec run = spec(code, "scene=kepler;t_end=1");
    std::int64_t heard = 0;
    double last = -1;
    const RunRecord all = execute(run, {nullptr,
                                        [&](const AcceptedStep& step) {
                                          ++heard;
                                          EXPECT_GT(step.t, last);
                                          last = step.t;
                                        },
                                        {}});
    EXPECT_EQ(heard, all.counters.steps_accepted + 1) << code;
    EXPECT_EQ(last, 1) << code;
    run.options.step.max_steps = 3;
    const RunRecord short_run = execute(run);
    EXPECT_EQ(short_run.outcome, "max_steps") << code;
    EXPECT_EQ(short_run.counters.steps_accepted, 3) << code;
  }
}

// x' = -log x from 10 on comes near to 1. With a long step Newton's method passes zero, where the logarithm is NaN.
struct Logarithm {
  static Sizes sizes() { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::log;
    r.x[0] = -log(T(p.x[0])) - p.k[0];
  }
};

TEST(FortranCodes, RepeatAStepWhoseRatesAreNotFinite) {
  Scene<double> scene;
  scene.id = "logarithm";
  scene.system = [](const SystemOptions& options) { return makeSystem<double>(Logarithm{}, options); };
  scene.start = State<double>(Logarithm::sizes());
  scene.start.x[0] = 10;
  for (const std::string code : kHairer) {
    PeerIntegrator integrator(*findPeer(loadMethod(at(code))), scene, spec(code, "scene=kepler;h=20"));
    const auto solution = integrator.integrate(scene.start, 20);
    ASSERT_EQ(solution.outcome, Outcome::kSuccess) << code << " " << solution.detail;
    EXPECT_NEAR(solution.state.x[0], 1, 1e-3) << code;
  }
  EXPECT_EQ(*SharedLibrary(kLibrary).get<int>("standin_not_finite"), 0);
}

TEST(FortranCodes, StepsPassIgnoredSwitches) {
  const auto scene = heatScene(true);
  for (const auto& code : kAll) {
    PeerIntegrator integrator(*findPeer(loadMethod(at(code))), scene, spec(code, "scene=kepler;discontinuity=ignore"));
    const auto solution = integrator.integrate(scene.start, 0.1);
    ASSERT_EQ(solution.outcome, Outcome::kSuccess) << code << " " << solution.detail;
    EXPECT_EQ(solution.counters.switches, 1) << code;
    EXPECT_EQ(solution.counters.located_events, 0) << code;
    // The switch heats the first point; without it, its heat would fade as exp(-pi^2 t).
    const double faded = scene.start.x[0] * std::exp(-0.1 * std::numbers::pi * std::numbers::pi);
    EXPECT_GT(solution.state.x[0], 1.5 * faded) << code;
  }
}

}  // namespace
}  // namespace irk
