// Solvers from outside the program: registered in C++, and loaded from shared libraries.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "experiments/runs/fields.h"
#include "experiments/runs/peers/catalogue.h"
#include "experiments/runs/peers/loaded/load_method.h"
#include "experiments/runs/peers/peer_integrator.h"
#include "experiments/runs/run.h"
#include "irk/peer.h"
#include "tests/experiments/runs/peer_runs.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

namespace fs = std::filesystem;

std::string solver(const std::string& name) { return std::string(IRK_SOLVERS "/") + name + ".so"; }

RunSpec ownSpec(const std::string& method, const std::string& rest, double tol = 1e-6) {
  return peerSpec(method, rest, tol);
}

/// Explicit Euler with the given step, for registerPeer.
class ExplicitEuler final : public Peer {
 public:
  explicit ExplicitEuler(const PeerSetup& setup) : setup_(setup) {}
  Outcome integrate(const PeerStart& start, double t_end, const PeerAccepted& accepted) override {
    const Index n = setup_.problem.layout().n;
    Vec<double> y = ConstVec<double>(start.y, n), f(n);
    double t = start.t;
    while (t < t_end) {
      if (setup_.problem.rates(t, y.data(), f.data()) != Evaluated::kDone) return Outcome::kNotFinite;
      const double h = std::min(setup_.h, t_end - t);
      y += h * f;
      t = h < setup_.h ? t_end : t + h;
      if (accepted({t, y.data()}) == PeerNext::kReturn) break;
    }
    return Outcome::kSuccess;
  }

 private:
  PeerSetup setup_;
};

TEST(OwnPeers, ARegisteredPeerRunsAsAnyOther) {
  const PeerEntry entry{.id = "explicit_euler",
                        .title = "Explicit Euler",
                        .make = makePeerOf<ExplicitEuler>,
                        .source = "0123456789abcdef"};
  registerPeer(entry);
  const PeerEntry* const found = findPeer("explicit_euler");
  ASSERT_NE(found, nullptr);
  EXPECT_EQ(found->source, "0123456789abcdef");
  RunSpec run = ownSpec("explicit_euler", "scene=kepler;t_end=1");
  double coarser = 0;
  for (const double h : {1e-3, 5e-4}) {
    run.options.step.h = h;
    const RunRecord record = peerSuccess(run);
    EXPECT_EQ(record.counters.residuals, record.counters.steps_accepted);
    EXPECT_NEAR(static_cast<double>(record.counters.steps_accepted), 1 / h, 1);
    const double size = record.u.norm();
    EXPECT_NE(size, coarser);
    coarser = size;
  }
  EXPECT_NE(keyText(resolved(run), {}).find("coefficients=0123456789abcdef"), std::string::npos);
  EXPECT_TRUE(containsAll(misuseOf([&] { registerPeer(entry); }), {"explicit_euler", "taken", "Explicit Euler"}));
  // Entries keep their addresses, which runs refer to.
  for (int i = 0; i < 100; ++i) {
    PeerEntry other = entry;
    other.id = "explicit_euler_" + std::to_string(i);
    other.source = "0123456789abcdef";
    registerPeer(other);
  }
  EXPECT_EQ(findPeer("explicit_euler"), found);
}

TEST(OwnPeers, TakenAndBadIdsAreRefused) {
  const auto refusal = [](const std::string& id) {
    return misuseOf([&] { registerPeer({.id = id, .title = "mine", .make = makePeerOf<ExplicitEuler>}); });
  };
  EXPECT_TRUE(containsAll(refusal("cvode_bdf"), {"cvode_bdf", "mine", "SUNDIALS CVODE"}));
  EXPECT_TRUE(containsAll(refusal("radau_iia_5"), {"radau_iia_5", "mine", "radau_iia", "family"}));
  EXPECT_TRUE(containsAll(refusal("a;b"), {"a;b", "letters"}));
  EXPECT_TRUE(containsAll(misuseOf([] { registerPeer({.id = "no_make", .title = "mine"}); }), {"no_make", "make"}));
  EXPECT_TRUE(
      containsAll(misuseOf([] { registerPeer({.id = "no_title", .title = "", .make = makePeerOf<ExplicitEuler>}); }),
                  {"no_title", "it has no title"}));
}

TEST(OwnPeers, ALibraryInCFollowsTheToleranceInEveryForm) {
  for (const char* name : {"euler_ode", "euler_mass", "euler_dae"}) {
    double coarser = 1;
    for (const double tol : {1e-3, 1e-5}) {
      const RunRecord run = peerSuccess(ownSpec(solver(name), "scene=riccati_tracking", tol));
      EXPECT_EQ(run.family, name);
      EXPECT_EQ(run.spec.method, name);
      EXPECT_LT(run.errors.all, 1000 * tol) << name;
      EXPECT_LT(run.errors.all, 0.1 * coarser) << name;
      coarser = run.errors.all;
      EXPECT_GT(run.counters.newton_iterations, run.counters.steps_accepted) << name;
      EXPECT_EQ(run.counters.jacobians, run.counters.newton_iterations) << name;
      // Those of the consistent start of the implicit form count as well.
      EXPECT_NEAR(static_cast<double>(run.counters.residuals), static_cast<double>(run.counters.newton_iterations), 3)
          << name;
    }
  }
}

// slider_crank: a mass matrix that depends on the state, and a multiplier; pendulum: a constant one.
TEST(OwnPeers, MassAndDaeFormsSolveConstraints) {
  for (const char* name : {"euler_mass", "euler_dae"}) {
    for (const char* rest : {"scene=pendulum;t_end=1;formulation=index1", "scene=pendulum;t_end=1",
                             "scene=slider_crank;t_end=0.1;formulation=index1"}) {
      const RunRecord run = peerSuccess(ownSpec(solver(name), rest, 1e-5));
      RunSpec reference = ownSpec("radau_iia_5", rest, 1e-10);
      const RunRecord exact = peerSuccess(reference);
      EXPECT_LT((run.u - exact.u).norm(), 1e-3 * exact.u.norm()) << name << " " << rest;
      EXPECT_LT((run.v - exact.v).norm(), 1e-2 * exact.v.norm()) << name << " " << rest;
      EXPECT_GT((run.u - exact.u).norm(), 1e-12) << name << " " << rest;
    }
  }
}

TEST(OwnPeers, ALibraryInCLocatesSwitches) {
  const RunSpec run = ownSpec(solver("euler_roots"), "scene=elastoplastic;discontinuity=locate;t_end=1", 1e-5);
  const RunRecord record = peerSuccess(run);
  const RunRecord exact =
      peerSuccess(ownSpec("radau_iia_5", "scene=elastoplastic;discontinuity=locate;t_end=1", 1e-10));
  EXPECT_EQ(record.counters.located_events, record.counters.switches);
  ASSERT_EQ(record.switches.size(), exact.switches.size());
  ASSERT_FALSE(exact.switches.empty());
  for (std::size_t i = 0; i < exact.switches.size(); ++i) {
    EXPECT_EQ(record.switches[i].name, exact.switches[i].name);
    EXPECT_NEAR(record.switches[i].t, exact.switches[i].t, 1e-2);
  }
}

TEST(OwnPeers, UnsupportedRunsAreRefused) {
  const auto refusal = [](const std::string& method, const std::string& rest) {
    return misuseOf([&] { prepare(ownSpec(solver(method), rest)); });
  };
  EXPECT_TRUE(containsAll(refusal("euler_ode", "scene=stick_slip;discontinuity=locate"), {"euler_ode", "locate"}));
  EXPECT_TRUE(containsAll(refusal("euler_ode", "scene=pendulum"), {"euler_ode", "index1"}));
  EXPECT_TRUE(containsAll(refusal("euler_dae", "scene=pendulum;formulation=index3"), {"euler_dae", "index 2"}));
  EXPECT_TRUE(containsAll(refusal("euler_dae", "scene=kepler;scalar=mp50"), {"euler_dae", "mp50"}));
}

TEST(OwnPeers, LimitsAndInterruptsEndALibrarysRun) {
  RunSpec run = ownSpec(solver("euler_ode"), "scene=kepler", 1e-9);
  run.options.step.max_steps = 3;
  EXPECT_EQ(execute(run).outcome, "max_steps");
  run.options.step.max_steps = 1'000'000;
  run.time_limit = 1e-9;
  EXPECT_EQ(execute(run).outcome, "timeout");
  run.time_limit = 0;
  const std::atomic<bool> stop = true;
  EXPECT_EQ(execute(run, {&stop, {}, {}}).outcome, "interrupted");
}

TEST(OwnPeers, FailuresOfALibraryAreRows) {
  RunSpec run = ownSpec(solver("euler_ode"), "scene=kepler", 1e-300);
  const RunRecord record = execute(run);
  EXPECT_EQ(record.outcome, "step_too_small");
  EXPECT_TRUE(containsAll(record.detail, {"the step is too small", "at t ="}));
}

TEST(OwnPeers, TheKeyContainsTheLibrarysContents) {
  const RunSpec run = ownSpec(solver("euler_ode"), "scene=kepler");
  const std::string hash = findPeer("euler_ode")->source;
  EXPECT_EQ(hash.size(), 16U);
  EXPECT_NE(hash, findPeer(loadMethod(solver("euler_roots")))->source);
  EXPECT_NE(keyText(resolved(run), {}).find("coefficients=" + hash), std::string::npos);
}

TEST(OwnPeers, FilesThatAreNoSolversAreRefused) {
  const TemporaryFolder folder;
  const auto refusal = [](const fs::path& path) { return misuseOf([&] { loadMethod(path.string()); }); };
  const fs::path text = folder.path() / "text.so";
  std::ofstream(text) << "no library\n";
  EXPECT_TRUE(containsAll(refusal(folder.path() / "none.so"), {"none.so"}));
  EXPECT_TRUE(containsAll(refusal(text), {"text.so"}));
  EXPECT_TRUE(containsAll(refusal(folder.path() / ".so"), {".so"}));
  EXPECT_TRUE(containsAll(refusal(solver("euler_newer")), {"euler_newer.so", "irk_peer_version", "2", "1"}));
  // Another file of the same name.
  const std::string id = loadMethod(solver("euler_ode"));
  const fs::path copy = folder.path() / "euler_ode.so";
  fs::copy_file(solver("euler_ode"), copy);
  EXPECT_TRUE(containsAll(refusal(copy), {"euler_ode", "taken"}));
  EXPECT_EQ(loadMethod(solver("euler_ode")), id);
  EXPECT_EQ(loadMethod("radau_iia_5"), "radau_iia_5");
}

}  // namespace
}  // namespace irk
