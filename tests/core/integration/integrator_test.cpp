// Complete runs: successes, failures by name, refusals, counters, equivalences.
#include <gtest/gtest.h>

#include "irk/multiprecision.h"
#include "tests/core/support.h"
#include "tests/refusal.h"

namespace irk::test {
namespace {

// The paper, section 2: 2-stage Lobatto IIIA in K-form is Newmark's method with beta 1/4, gamma 1/2:
//   u1 = u0 + h v0 + h^2/4 (a0 + a1),  v1 = v0 + h/2 (a0 + a1),  r(u1, v1, a1) = 0.
struct Duffing {
  Sizes sizes() const { return {.nu = 1, .nx = 0, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    r.u[0] = cos(p.t) - p.u[0] - p.u[0] * p.u[0] * p.u[0] - 0.2 * p.v[0] - 2.0 * p.a[0];
  }
};

TEST(Integrator, TwoStageLobattoIiiaIsNewmark) {
  const auto start = startOf(Duffing{}, {.u = {0.7}, .v = {-0.3}});
  const double h = 0.1;
  const auto force = [](double t, double u, double v) { return (std::cos(t) - u - u * u * u - 0.2 * v) / 2; };
  double t = 0, u = 0.7, v = -0.3, a = force(t, u, v);
  for (int step = 0; step < 20; ++step) {
    double a1 = a;
    for (int i = 0; i < 100; ++i) {  // contraction h^2/4 |df/du| < 0.02 per iteration
      a1 = force(t + h, u + h * v + h * h / 4 * (a + a1), v + h / 2 * (a + a1));
    }
    u += h * v + h * h / 4 * (a + a1);
    v += h / 2 * (a + a1);
    a = a1;
    t += h;
  }
  const auto s = integrate<double>(Duffing{}, start, 2, makeTableau<double>("lobatto_iiia_2"), fixedSteps(h));
  ASSERT_EQ(s.outcome, Outcome::kSuccess);
  EXPECT_NEAR(s.state.u[0], u, 50 * 2.2e-16);
  EXPECT_NEAR(s.state.v[0], v, 50 * 2.2e-16);
  EXPECT_NEAR(s.state.a()[0], a, 200 * 2.2e-16);
}

TEST(Integrator, ToleranceIsReachedByEveryNewton) {
  for (const auto& newton : named<NewtonKind>()) {
    IntegratorOptions o = adaptive(1e-9);
    o.newton.kind = newton.value;
    o.solver = StageSolverKind::kCoupledDense;
    const auto s = integrate<double>(Riccati{}, riccatiStart<double>(), 2, makeTableau<double>("radau_iia_3"), o);
    ASSERT_EQ(s.outcome, Outcome::kSuccess) << newton.id << s.detail;
    EXPECT_LT(std::abs(s.state.x[0] - 1.5 - std::sin(2.0)), 1e-8) << newton.id;
    EXPECT_GT(s.counters.steps_accepted, 3) << newton.id;
  }
}

TEST(Integrator, MultiprecisionGoesBelowDouble) {
  const auto s =
      integrate<BigFloat>(Riccati{}, riccatiStart<BigFloat>(), 2, makeTableau<BigFloat>("gauss_12"), fixedSteps(0.05));
  ASSERT_EQ(s.outcome, Outcome::kSuccess);
  const BigFloat exact = BigFloat(1.5) + sin(BigFloat(2));
  EXPECT_LT(std::abs(static_cast<double>(BigFloat(s.state.x[0] - exact))), 1e-35);
}

// A linear problem with constant coefficients needs one Jacobian, one factorization, and per step one iteration of
// the paper's Newton method, after which the residual is at round-off. (`modified` would look at one more increment.)
TEST(Integrator, CountersAreWhatTheAlgorithmSays) {
  IntegratorOptions o = fixedSteps(0.125);
  o.predictor = Predictor::kAcceleration;
  o.newton.kind = parseId<NewtonKind>("paper_rule");
  const auto s = integrate<double>(Decay{}, decayStart(), 1, makeTableau<double>("radau_iia_2"), o);
  ASSERT_EQ(s.outcome, Outcome::kSuccess);
  EXPECT_EQ(s.counters.steps_accepted, 8);
  EXPECT_EQ(s.counters.jacobians, 1 + 1) << "one of the consistent start";
  EXPECT_EQ(s.counters.factorizations, 1);
  EXPECT_EQ(s.counters.newton_iterations, 8);
  EXPECT_EQ(s.counters.solves, 8);
  EXPECT_EQ(s.counters.newton_restarts, 0);
}

TEST(Integrator, FixedStepsEndAtTheEnd) {
  for (const double h : {0.1, 0.3, 2.0}) {
    const auto s = integrate<double>(Decay{}, decayStart(), 1, makeTableau<double>("gauss_8"), fixedSteps(h));
    EXPECT_EQ(s.outcome, Outcome::kSuccess);
    EXPECT_EQ(s.state.t, 1.0);
    EXPECT_NEAR(s.state.x[0], std::exp(-1.0), 1e-14);
    EXPECT_EQ(s.counters.steps_accepted, static_cast<int>(std::ceil(1 / h - 1e-9)));
  }
}

TEST(Integrator, ARunStopsWhereItsCallerSays) {
  Integrator<double> integrator(makeSystem<double>(Decay{}), makeTableau<double>("gauss_1"), fixedSteps(0.1));
  int steps = 0;
  Monitor<double> monitor;
  monitor.accepted = [&](const StepRecord<double>&) { ++steps; };
  monitor.interrupt = [&] { return steps == 3 ? Outcome::kTimeout : Outcome::kSuccess; };
  const auto s = integrator.integrate(decayStart(), 1.0, monitor);
  EXPECT_EQ(s.outcome, Outcome::kTimeout);
  EXPECT_NEAR(s.state.t, 0.3, 1e-15);
  EXPECT_EQ(integrator.integrate(decayStart(), 1.0).outcome, Outcome::kSuccess);
}

TEST(Integrator, NotANumberIsNamed) {
  const auto run = [](double until) {
    const FirstOrder problem{[until](const auto& p) {
      using std::sqrt;
      return sqrt(until - p.t);
    }};
    const State<double> start(problem.sizes());
    return integrate<double>(problem, start, 1, makeTableau<double>("radau_iia_2"), adaptive(1e-6));
  };
  const auto at_once = run(-1);
  EXPECT_EQ(at_once.outcome, Outcome::kNotFinite);
  EXPECT_TRUE(contains(at_once.detail, "row 0"));
  const auto later = run(0.5);
  EXPECT_EQ(later.outcome, Outcome::kNotFinite) << later.detail;
  EXPECT_NEAR(later.state.t, 0.5, 1e-3);
}

TEST(Integrator, AnInconsistentStartIsNamed) {
  State<double> off = pendulumStart<double>();
  off.u[0] = 1.01;
  auto s = integrate<double>(CartesianPendulum{}, off, 1, makeTableau<double>("radau_iia_2"), adaptive(1e-6));
  EXPECT_EQ(s.outcome, Outcome::kInconsistentStart);
  EXPECT_TRUE(contains(s.detail, "constraint g[0] = 0.01"));
  State<double> moving = pendulumStart<double>();
  moving.v[0] = 0.1;
  s = integrate<double>(CartesianPendulum{}, moving, 1, makeTableau<double>("radau_iia_2"), adaptive(1e-6));
  EXPECT_EQ(s.outcome, Outcome::kInconsistentStart);
  EXPECT_TRUE(contains(s.detail, "dg/dt[0] = 0.1"));
}

TEST(Integrator, AStartIsJudgedRelativeToTheScale) {
  State<double> slow = pendulumStart<double>();
  slow.v[0] = 1e-5;
  const auto outcome = [&](double scale_of_v) {
    Vec<double> scale(5);
    scale << 1, 1, scale_of_v, scale_of_v, 1;
    Integrator<double> integrator(makeSystem<double>(CartesianPendulum{}), makeTableau<double>("radau_iia_2"),
                                  adaptive(1e-3), scale);
    return name(integrator.integrate(slow, 0.0).outcome);
  };
  EXPECT_EQ(outcome(1), "inconsistent_start");
  EXPECT_EQ(outcome(1e3), "success");
}

TEST(Integrator, TheStartGetsItsAccelerationsAndMultiplier) {
  State<double> start = pendulumStart<double>();
  start.v[1] = -2;  // lambda = |v|^2 - g y = 4, a = (-4, -9.81)
  const auto s =
      integrate<double>(CartesianPendulum{}, start, 0, makeTableau<double>("lobatto_iiia_3"), adaptive(1e-6));
  EXPECT_EQ(s.outcome, Outcome::kSuccess);
  EXPECT_NEAR(s.state.z()[0], 4, 1e-13);
  EXPECT_NEAR(s.state.a()[0], -4, 1e-13);
}

TEST(Integrator, IllegalCombinationsAreRefused) {
  const auto refused = [](auto problem, const char* method, const IntegratorOptions& o) {
    return refusal([&] { Integrator<double>(makeSystem<double>(problem), makeTableau<double>(method), o); });
  };
  for (const char* method : {"lobatto_iiib_3", "lobatto_iiics_2"}) {
    EXPECT_TRUE(containsAll(refused(CartesianPendulum{}, method, adaptive(1e-6)), {method, "algebraic"}));
  }
  IntegratorOptions o = adaptive(1e-6);
  o.newton.kind = NewtonKind::kFull;
  EXPECT_TRUE(containsAll(refused(Riccati{}, "gauss_2", o), {"full", "schur", "coupled_dense"}));
  o.solver = StageSolverKind::kCoupledDense;
  o.step.estimate = ErrorEstimate::kEmbedded;
  EXPECT_TRUE(containsAll(refused(Riccati{}, "gauss_2", o), {"full", "embedded", "richardson"}));
  o = adaptive(1e-6);
  o.step.estimate = ErrorEstimate::kNone;
  EXPECT_TRUE(containsAll(refused(Riccati{}, "gauss_2", o), {"none", "predictive"}));
  o = adaptive(1e-6);
  o.solver = StageSolverKind::kEigen;
  EXPECT_TRUE(containsAll(refused(Riccati{}, "lobatto_iiics_3", o), {"eigen", "defective"}));
}

}  // namespace
}  // namespace irk::test
