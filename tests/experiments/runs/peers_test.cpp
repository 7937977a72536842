#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "experiments/runs/fields.h"
#include "experiments/runs/peers/catalogue.h"
#include "experiments/runs/peers/peer_integrator.h"
#include "experiments/runs/run.h"
#include "tests/experiments/runs/peer_runs.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

bool isMissing(std::string_view peer) { return peer.starts_with("gsl_") && !hasGsl(); }

// The peers of the program, without those that other tests register.
std::vector<PeerEntry> builtinPeers() {
  std::vector<PeerEntry> all;
  for (const auto& peer : peerCatalogue()) {
    if (peer.source.empty() && !isMissing(peer.id)) all.push_back(peer);
  }
  return all;
}

// Control of the local error per step gives some tolerances in total. The lower bound only checks that the tolerance
// has an effect: a hundredth of it must give a smaller error. (An extrapolation method is much more accurate than
// requested if its first step is long enough.)
TEST(Peers, AllFollowTheToleranceOnAnOde) {
  for (const auto& peer : builtinPeers()) {
    double coarser = 1;
    for (const double tol : {1e-5, 1e-7, 1e-9}) {
      const RunRecord run = peerSuccess(peerSpec(peer.id, "scene=riccati_tracking", tol));
      EXPECT_LT(run.errors.all, 100 * tol) << peer.id;
      EXPECT_LE(run.errors.all, coarser) << peer.id;
      coarser = run.errors.all;
      EXPECT_EQ(run.family, peer.id);
      EXPECT_EQ(run.stages, 0);
      EXPECT_GT(run.counters.steps_accepted, 0);
      EXPECT_GT(run.counters.residuals, run.counters.steps_accepted);
    }
  }
}

// IRK_GSL=OFF: they are known, and a run of them is refused by name.
TEST(Peers, AProgramWithoutGslSaysSo) {
  for (const std::string peer : {"gsl_bsimp", "gsl_msbdf", "gsl_rk4imp"}) {
    ASSERT_NE(findPeer(peer), nullptr);
    EXPECT_EQ(findPeer(peer)->title.find("not in this program") == std::string::npos, hasGsl());
    const RunSpec spec = peerSpec(peer, "scene=kepler");
    const RunRecord run = asRow(spec, [&] { return execute(spec); });
    EXPECT_EQ(run.outcome, hasGsl() ? "success" : "refused") << run.detail;
    if (hasGsl()) continue;
    EXPECT_TRUE(containsAll(run.detail, {"'" + peer + "'", "without GSL", "IRK_GSL=ON"}));
  }
}

TEST(Peers, StiffProblems) {
  for (const char* peer : {"arkode_dirk", "cvode_bdf", "ida_bdf", "gsl_msbdf", "gsl_bsimp"}) {
    if (isMissing(peer)) continue;
    // Each of two transitions of the relaxation oscillation amplifies errors; together by about 1e3.
    const RunRecord run = peerSuccess(peerSpec(peer, "scene=van_der_pol"));
    EXPECT_LT(run.errors.all, 1e-5) << peer;
    EXPECT_GT(run.errors.all, 1e-10) << peer;
    EXPECT_GT(run.counters.jacobians, 0) << peer;
  }
}

TEST(Peers, AllSolveTheConstrainedPendulumInIndex1) {
  for (const auto& peer : builtinPeers()) {
    const RunRecord run = peerSuccess(peerSpec(peer.id, "scene=pendulum;t_end=10;formulation=index1"));
    EXPECT_LT(run.errors.all, 1e-3) << peer.id;  // the constraint drifts, and five turns amplify errors
    EXPECT_GT(run.errors.all, 1e-9) << peer.id;
    EXPECT_FALSE(std::isnan(run.errors.z)) << peer.id;
  }
}

TEST(Peers, IdasMultipliersAreSolvedAnewAtTheEnd) {
  const auto scene = makeScene<double>("pendulum");
  const auto change = [&](const std::string& multipliers) {
    const RunSpec run = peerSpec("ida_bdf", "scene=pendulum;t_end=1;multipliers=" + multipliers, 1e-5);
    PeerIntegrator peer(*findPeer("ida_bdf"), scene, run);
    const auto solution = peer.integrate(scene.start, 1);
    EXPECT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
    State<double> again = solution.state;
    const auto system = scene.system({});
    EXPECT_EQ(ConsistentStart<double>(*system, DerivativeSource::kAutomatic, false).applyAtEnd(again), "");
    return std::abs(again.z()[0] - solution.state.z()[0]);
  };
  EXPECT_LT(change("consistent"), 1e-13);
  EXPECT_GT(change("stages"), 1e-9);
}

TEST(Peers, IdaSolvesIndex2) {
  for (const char* rest :
       {"scene=pendulum", "scene=pendulum;formulation=ggl", "scene=slider_crank;t_end=1", "scene=index2_nonlinear"}) {
    const RunRecord run = peerSuccess(peerSpec("ida_bdf", rest));
    EXPECT_LT(run.errors.all, 2e-4) << rest;
    EXPECT_GT(run.errors.all, 1e-8) << rest;
  }
}

TEST(Peers, RunsDoNotDependOnEarlierRuns) {
  for (const auto& peer : builtinPeers()) {
    const auto run = prepare(peerSpec(peer.id, "scene=pendulum;t_end=1;formulation=index1"));
    const RunRecord first = run->execute({}), second = run->execute({});
    EXPECT_EQ(first.u, second.u) << peer.id;
    EXPECT_EQ(first.counters.residuals, second.counters.residuals) << peer.id;
  }
}

TEST(Peers, LimitsAndInterruptsEndARun) {
  for (const auto& peer : builtinPeers()) {
    RunSpec run = peerSpec(peer.id, "scene=kepler");
    std::int64_t heard = 0;
    const RunRecord all = execute(run, {nullptr, [&heard](const AcceptedStep&) { ++heard; }, {}});
    EXPECT_EQ(heard, all.counters.steps_accepted + 1) << peer.id;
    const std::atomic<bool> stop = true;
    EXPECT_EQ(execute(run, {&stop, {}, {}}).outcome, "interrupted") << peer.id;
    run.options.step.max_steps = 3;
    EXPECT_EQ(execute(run).outcome, "max_steps") << peer.id;
    run.time_limit = 1e-9;
    EXPECT_EQ(execute(run).outcome, "timeout") << peer.id;
  }
}

TEST(Peers, IllegalCombinationsAreRefused) {
  const auto refusal = [](const std::string& method, const std::string& rest) {
    return misuseOf([&] { prepare(peerSpec(method, rest)); });
  };
  for (const auto& peer : builtinPeers()) {
    const auto& id = peer.id;
    EXPECT_TRUE(containsAll(refusal(id, "scene=kepler;control=fixed;h=0.1"), {id, "fixed"}));
    EXPECT_TRUE(containsAll(refusal(id, "scene=kepler;scalar=mp50"), {id, "mp50"}));
    EXPECT_TRUE(containsAll(refusal(id, "scene=kepler;norm=absolute"), {id, "absolute"}));
    EXPECT_TRUE(containsAll(refusal(id, "scene=kepler;discontinuity=iterate"), {id, "iterate"}));
    EXPECT_TRUE(containsAll(refusal(id, "scene=pendulum;formulation=index3"), {id, "index3"}));
    if (!peer.takesConstraints()) {
      EXPECT_TRUE(containsAll(refusal(id, "scene=pendulum"), {id, "index2", "index1"}));
      EXPECT_TRUE(containsAll(refusal(id, "scene=index2_nonlinear"), {id, "index2_nonlinear"}));
    }
    if (!peer.finds_roots) {
      EXPECT_TRUE(containsAll(refusal(id, "scene=stick_slip;discontinuity=locate"), {id, "locate"}));
    }
  }
  const RunSpec fixed = peerSpec("cvode_bdf", "scene=kepler;control=fixed;h=0.1");
  const RunRecord row = asRow(fixed, [&] { return execute(fixed); });
  EXPECT_EQ(row.outcome, "refused");
  EXPECT_EQ(row.family, "cvode_bdf");
}

/// u'' = d - u; d changes from 1 to 0 when u has risen to 1/2.
struct Relay {
  Sizes sizes() const { return {.nu = 1, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = p.d[0] - p.u[0] - p.a[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = p.d[0] > T(0.5) ? T(p.u[0] - 0.5) : T(-1.0);
  }
  template <class T>
  void onSwitch(Index, const Point<T>&, T* d) const {
    d[0] = T(0.0);
  }
};

constexpr double kRelayTime = std::numbers::pi / 3, kRelayEnd = 2;

Scene<double> relayScene() {
  Scene<double> scene;
  scene.id = "relay";
  scene.system = [](const SystemOptions& options) { return makeSystem<double>(Relay{}, options); };
  scene.start = State<double>(Relay{}.sizes());
  scene.start.d[0] = scene.start.w[0] = 1;
  return scene;
}

double relayError(double u) {
  const double later = kRelayEnd - kRelayTime;
  return std::abs(u - (0.5 * std::cos(later) + std::sin(kRelayTime) * std::sin(later)));
}

TEST(Peers, LocatedSwitchesRestart) {
  const auto scene = relayScene();
  for (const auto& peer : builtinPeers()) {
    if (!peer.finds_roots) continue;
    PeerIntegrator integrator(peer, scene, peerSpec(peer.id, "scene=stick_slip;discontinuity=locate"));
    double at = 0;
    Monitor<double> monitor;
    monitor.switched = [&at](const SwitchRecord<double>& record) { at = record.t; };
    const auto end = integrator.integrate(scene.start, kRelayEnd, monitor);
    ASSERT_EQ(end.outcome, Outcome::kSuccess) << end.detail;
    EXPECT_EQ(end.counters.located_events, 1) << peer.id;
    EXPECT_EQ(end.state.d[0], 0) << peer.id;
    // As accurate as the interpolant in which the library searches the root.
    EXPECT_NEAR(at, kRelayTime, 1e-5) << peer.id;
    EXPECT_LT(relayError(end.state.u[0]), 1e-5) << peer.id;
    const auto again = integrator.integrate(scene.start, kRelayEnd);
    EXPECT_EQ(again.state.u[0], end.state.u[0]) << peer.id;
    EXPECT_EQ(again.counters.residuals, end.counters.residuals) << peer.id;
  }
}

// The estimate may miss a switch: if no stage lies in the part of the step before it, or if Newton's method accepts a
// linear problem after one iteration. The error of large steps is then proportional to their square.
TEST(Peers, IgnoredSwitchesAreLeftToTheErrorEstimate) {
  const auto scene = relayScene();
  for (const auto& peer : builtinPeers()) {
    PeerIntegrator integrator(peer, scene, peerSpec(peer.id, "scene=kepler;discontinuity=ignore"));
    const auto end = integrator.integrate(scene.start, kRelayEnd);
    ASSERT_EQ(end.outcome, Outcome::kSuccess) << peer.id << ": " << end.detail;
    EXPECT_EQ(end.counters.switches, 1) << peer.id;
    EXPECT_EQ(end.counters.located_events, 0) << peer.id;
    EXPECT_LT(relayError(end.state.u[0]), 0.3) << peer.id;
  }
}

/// Its switching function is infinite beyond its root.
struct BrokenRelay : Relay {
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = p.u[0] < T(0.5) ? T(-1.0) : T(std::numeric_limits<double>::infinity());
  }
};

// SUNDIALS would look for the root for ever.
TEST(Peers, ASwitchingFunctionThatIsNotFiniteEndsTheRun) {
  auto scene = relayScene();
  scene.system = [](const SystemOptions& options) { return makeSystem<double>(BrokenRelay{}, options); };
  for (const auto& peer : builtinPeers()) {
    if (!peer.finds_roots) continue;
    PeerIntegrator integrator(peer, scene, peerSpec(peer.id, "scene=stick_slip;discontinuity=locate"));
    EXPECT_EQ(integrator.integrate(scene.start, kRelayEnd).outcome, Outcome::kNotFinite) << peer.id;
  }
}

// A ball that falls for 1 s and keeps half of its speed at the floor comes to rest at t = 3.
TEST(Peers, SwitchesWithoutEndAreAnOutcome) {
  const auto scene = makeScene<double>("bouncing_ball", {{"e", "0.5"}, {"h0", "4.905"}});
  for (const auto& peer : builtinPeers()) {
    if (!peer.finds_roots) continue;
    PeerIntegrator integrator(peer, scene, peerSpec(peer.id, "scene=bouncing_ball;discontinuity=locate"));
    const auto before = integrator.integrate(scene.start, 2.5);
    EXPECT_EQ(before.outcome, Outcome::kSuccess) << peer.id << ": " << before.detail;
    const auto after = integrator.integrate(scene.start, 5);
    EXPECT_TRUE(after.outcome == Outcome::kStalled || after.outcome == Outcome::kChattering)
        << peer.id << ": " << name(after.outcome) << " " << after.detail;
    EXPECT_NEAR(after.state.t, 3, 0.1) << peer.id;
    EXPECT_LT(after.counters.steps_accepted, 500'000) << peer.id;
  }
}

// --- The form y' = f(t, y) that ODE codes require.

TEST(FirstOrderForm, HasTheAccelerationsOfTheResidual) {
  for (const char* id : {"slider_crank", "pendulum", "van_der_pol", "index1_nonlinear"}) {
    const auto scene = makeScene<double>(id);
    const auto system = scene.system({Formulation::kFirstOrder});
    const auto start = system->fromScene(scene.start);
    EXPECT_LT((system->toScene(start).w - scene.start.w).norm(), 1e-12) << id;
    Vec<double> r(system->sizes().n());
    system->evaluate(Level::kFormulated, pointOf(start), {r.data(), r.size()});
    EXPECT_LT(r.norm(), 1e-12) << id;
  }
}

TEST(FirstOrderForm, ImplicitDerivativesAreThoseOfDifferences) {
  for (const char* id : {"slider_crank", "pendulum", "hires", "index1_nonlinear"}) {
    const auto scene = makeScene<double>(id);
    const auto system = scene.system({Formulation::kFirstOrder});
    State<double> at = system->fromScene(scene.start);
    for (Index i = 0; i < at.x.size(); ++i) at.x[i] += 0.01 * static_cast<double>(i + 1);
    Linearization<double> exact(Pattern::dense(system->sizes().n())), differences = exact;
    Differentiator<double>(*system, DerivativeSource::kAutomatic).evaluate(Level::kFormulated, pointOf(at), exact);
    Differentiator<double>(*system, DerivativeSource::kCentral).evaluate(Level::kFormulated, pointOf(at), differences);
    const double size = exact.d1.norm();
    EXPECT_LT((exact.d1 - differences.d1).norm(), 1e-7 * size) << id;
    EXPECT_LT((exact.d0 - differences.d0).norm(), 1e-7) << id;
  }
}

TEST(FirstOrderForm, AgreesWithTheKForm) {
  for (const char* id : {"slider_crank", "pendulum"}) {
    const std::string scene = std::string("scene=") + id + ";t_end=1;formulation=";
    const RunRecord k = peerSuccess(peerSpec("radau_iia_5", scene + "index1", 1e-10));
    const RunRecord first = peerSuccess(peerSpec("radau_iia_5", scene + "first_order", 1e-10));
    EXPECT_LT((k.u - first.u).norm(), 1e-8 * k.u.norm()) << id;
    EXPECT_LT((k.z - first.z).norm(), 1e-7 * k.z.norm()) << id;
    EXPECT_EQ(k.counters.mass_factorizations, 0) << id;
    EXPECT_GE(first.counters.mass_factorizations, first.counters.steps_accepted) << id;
  }
}

}  // namespace
}  // namespace irk
