#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <memory>
#include <type_traits>
#include <vector>

#include "core/control/controller.h"
#include "core/derivatives/differentiator.h"
#include "core/estimates/step_attempt.h"
#include "core/stages/error_norm.h"
#include "tests/core/support.h"
#include "tests/core/watched.h"

namespace irk::test {
namespace {

// Jacobians of the consistent start.
constexpr int kOfStart = 1;

/// x' = -rate x, and from t = 0.09 on faster by a factor of 1.8 (or another one).
auto faster(double factor = 1.8) {
  return FirstOrder{[factor]<class T>(const Point<T>& p) { return (p.t > T(0.09) ? -1e4 * factor : -1e4) * p.x[0]; }};
}

// Two steps of the midpoint rule, h = 0.1. The first one needs one iteration. In the second one the kept matrix is 1
// + 500 instead of 1 + 900, so residuals shrink by 400/501 = 0.798 until the Jacobian is evaluated again. This
// follows the paper's (3.2) and (3.4), iteration by iteration.
TEST(PapersNewton, FollowsItsRules) {
  const auto start = startOf(faster(), {.x = {1}});
  const auto run = [&](double tolerance, double limit, int after, int most) {
    IntegratorOptions o = fixedSteps(0.1);
    o.newton.kind = parseId<NewtonKind>("paper_rule");  // `modified` would go on to round-off
    o.newton.residual_tolerance = tolerance;
    o.newton.contractivity_limit = limit;
    o.newton.contractivity_after = after;
    o.newton.max_iterations = most;
    o.predictor = Predictor::kAcceleration;
    o.jacobian_point = JacobianPoint::kStart;
    const auto solution = integrate<double>(faster(), start, 0.2, makeTableau<double>("gauss_1"), o);
    EXPECT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
    return solution.counters;
  };
  EXPECT_EQ(run(1e-1, 0.9, 3, 25).newton_iterations, 1 + 11) << "0.798^11 < 0.1";
  EXPECT_EQ(run(1e-2, 0.9, 3, 25).newton_iterations, 1 + 21);
  EXPECT_EQ(run(1e-2, 0.9, 3, 25).newton_restarts, 0);
  EXPECT_EQ(run(1e-2, 0.9, 3, 25).jacobians, kOfStart + 1);
  for (const int after : {1, 3, 6}) {
    const Counters c = run(1e-2, 0.7, after, 25);
    EXPECT_EQ(c.newton_iterations, 1 + after + 1 + 1) << "one more than " << after;
    EXPECT_EQ(c.newton_restarts, 1);
    EXPECT_EQ(c.jacobians, kOfStart + 2);
  }
  EXPECT_EQ(run(1e-2, 0.9, 3, 10).newton_iterations, 1 + 10 + 1) << "max_iterations";
  EXPECT_EQ(run(1e-2, 0.79, 3, 25).newton_restarts, 1) << "just above the limit";
  EXPECT_EQ(run(1e-2, 0.81, 3, 25).newton_restarts, 0) << "just below it";
}

// With 2.5 times the rate increments grow by 1.5: Newton fails and starts again with a new Jacobian. The step counts
// all of its iterations.
TEST(Counted, IterationsOfStepsAreThoseOfTheRun) {
  const auto start = startOf(faster(), {.x = {1}});
  for (const auto kind : {NewtonKind::kSimplified, NewtonKind::kModified}) {
    IntegratorOptions o = fixedSteps(0.1);
    o.newton.kind = kind;
    o.predictor = Predictor::kAcceleration;
    Integrator<double> integrator(makeSystem<double>(faster(2.5)), makeTableau<double>("gauss_1"), o);
    std::int64_t sum = 0;
    Monitor<double> monitor;
    monitor.accepted = [&](const StepRecord<double>& s) { sum += s.newton_iterations; };
    const auto solution = integrator.integrate(start, 0.4, monitor);
    ASSERT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
    EXPECT_EQ(solution.counters.newton_restarts, 1) << idOf(kind);
    EXPECT_EQ(sum, solution.counters.newton_iterations) << idOf(kind);
  }
}

// Checks each number: weights atol scale + rtol |y|, powers of h by index, the mean over (u, v, x, z).
TEST(ErrorNorms, AreWhatTheirOptionsSay) {
  const auto system = makeSystem<double>(CartesianPendulum{}, {Formulation::kIndex3});
  Vec<double> scale(5);
  scale << 1, 2, 3, 4, 5;
  State<double> y(CartesianPendulum{}.sizes()), p = y, q = y;
  y.u << 10, 20;
  y.v << -30, 40;
  y.z() << 50;
  p.u << 1, 2;
  p.v << 3, 4;
  p.z() << 5;
  const Vec<double> ones = Vec<double>::Ones(5);
  const double h = 0.5;
  ErrorNorm<double> mixed(*system, {0.01, 0.1, NormKind::kMixed}, scale);
  mixed.update(y);
  // z is multiplied by h^2; v is integrated, but has index 2 all the same.
  const double e[] = {1 / (0.1 + 0.1), 2 / (0.2 + 0.2), 3 / (0.3 + 0.3), 4 / (0.4 + 0.4), 1.25 / (0.5 + 0.5)};
  double sum = 0;
  for (const double one : e) sum += one * one;
  EXPECT_NEAR(mixed.difference(p, q, h, ones), std::sqrt(sum / 5), 1e-13);
  EXPECT_NEAR(mixed.magnitude(p, h), std::sqrt(sum / 5), 1e-13);
  Vec<double> factor(5);
  factor << 0, 0, 0, 0, 2;
  EXPECT_NEAR(mixed.difference(p, q, h, factor), std::sqrt(2.5 * 2.5 / 5), 1e-13);
  ErrorNorm<double> absolute(*system, {0.01, 0.1, NormKind::kAbsolute}, scale);
  absolute.update(y);
  EXPECT_NEAR(absolute.difference(p, q, h, ones), std::sqrt(1 + 4 + 9 + 16 + 1.25 * 1.25) / 0.1, 1e-12);
}

// The absolute norm knows no magnitudes. A scale that is given later can only make it stricter.
TEST(ErrorNorms, WeighAbsoluteErrorsBySmallScalesThatAreGivenLater) {
  const auto system = makeSystem<double>(Coupled{});
  const auto y = startOf(Coupled{}, {.u = {0.01, -0.25}, .v = {4, 8}, .x = {0.5}});
  ErrorNorm<double> norm(*system, {0, 0.1, NormKind::kAbsolute}, Vec<double>::Constant(6, 1e-3));
  norm.update(y);
  EXPECT_EQ(norm.weights(), Vec<double>::Constant(6, 0.1));
  norm.setScale(Vec<double>{{1e-100, 1e-100, 1e-100, 1, 0.25, 10}});
  norm.update(y);
  EXPECT_LT((norm.weights() - Vec<double>{{0.001, 0.025, 0.1, 0.1, 0.075, 0.1}}).norm(), 1e-15);
}

TEST(ErrorNorms, WeighEveryComponentByItself) {
  const auto system = makeSystem<double>(Coupled{});
  State<double> y(Coupled{}.sizes()), zero = y;
  y.u << 1, 2;
  y.v << 4, 8;
  y.x << 16;
  y.z() << 32;
  ErrorNorm<double> norm(*system, {0.5, 1e-300, NormKind::kMixed}, {});
  norm.update(y);
  Vec<double> one = Vec<double>::Zero(6);
  for (Index i = 0; i < 5; ++i) {
    one.setZero();
    one[i] = 1;
    EXPECT_NEAR(norm.difference(y, zero, 1, one), 2 / std::sqrt(6), 1e-13) << "component " << i;
  }
}

// Factors 2^q - 1 with the order q of each component; HW II, tables VII.4.1 and VII.6.1 for the orders of the stages.
TEST(RichardsonFactors, AreOfTheComponentsOrders) {
  const auto orders = [](const char* method, Formulation formulation, ErrorEstimate estimate) {
    const auto system = makeSystem<double>(CartesianPendulum{}, {formulation});
    const Vec<double> factor = doublingFactors(Scheme<double>(makeTableau<double>(method)), *system, estimate);
    std::vector<double> found;
    for (const double f : factor) found.push_back(std::round(1e6 * std::log2(1 / f + 1)) / 1e6);
    return found;
  };
  using Orders = std::vector<double>;
  constexpr auto kOwn = ErrorEstimate::kRichardson, kAll = ErrorEstimate::kDoubling;
  // u1, u2, v1, v2, z
  EXPECT_EQ(orders("radau_iia_3", Formulation::kIndex2, kOwn), (Orders{5, 5, 5, 5, 3}));
  EXPECT_EQ(orders("radau_iia_3", Formulation::kIndex3, kOwn), (Orders{5, 5, 3, 3, 2}));
  EXPECT_EQ(orders("radau_iia_3", Formulation::kIndex1, kOwn), (Orders{5, 5, 5, 5, 5}));
  EXPECT_EQ(orders("gauss_3", Formulation::kIndex2, kOwn), (Orders{6, 6, 3, 3, 3}));
  EXPECT_EQ(orders("gauss_3", Formulation::kIndex3, kOwn), (Orders{3, 3, 3, 3, 2}));
  EXPECT_EQ(orders("radau_iia_3", Formulation::kIndex3, kAll), (Orders{5, 5, 5, 5, 5}));
}

// Simplified Newton evaluates s residuals per iteration; the residual test needs one more set of s per solve.
TEST(Counted, ResidualsAreWhatTheAlgorithmsNeed) {
  const auto counters = [&](NewtonKind kind, const char* method, int steps) {
    IntegratorOptions o = fixedSteps(1.0 / steps);
    o.newton.kind = kind;
    o.solver = StageSolverKind::kCoupledDense;
    o.predictor = Predictor::kAcceleration;
    return integrate<double>(Decay{}, decayStart(), 1, makeTableau<double>(method), o).counters;
  };
  struct Case {
    const char* method;
    int implicit;
  };
  for (const auto& [method, s] : {Case{"radau_iia_3", 3}, Case{"gauss_2", 2}, Case{"lobatto_iiia_4", 3}}) {
    for (const auto kind : {NewtonKind::kSimplified, NewtonKind::kModified, NewtonKind::kFull}) {
      const Counters few = counters(kind, method, 8), many = counters(kind, method, 24);
      const auto iterations = many.newton_iterations - few.newton_iterations;
      const auto first = kind == NewtonKind::kSimplified ? 0 : 16;
      EXPECT_EQ(many.residuals - few.residuals, s * (iterations + first)) << method << idOf(kind);
      EXPECT_EQ(many.solves - few.solves, iterations) << method << idOf(kind);
      EXPECT_EQ(many.steps_accepted - few.steps_accepted, 16);
      if (kind == NewtonKind::kFull) {
        EXPECT_EQ(many.jacobians - few.jacobians, s * iterations) << "one per stage";
        EXPECT_EQ(many.factorizations - few.factorizations, iterations);
      } else {
        EXPECT_EQ(many.jacobians, few.jacobians) << "linear: one serves all";
      }
    }
  }
}

// Step doubling solves one step and two half steps; it keeps a factorization for each of the two step sizes.
TEST(Counted, DoublingSolvesThreeTimes) {
  for (const auto estimate : {ErrorEstimate::kDoubling, ErrorEstimate::kRichardson, ErrorEstimate::kDoublingScalar}) {
    IntegratorOptions o = adaptive(1e-2);
    o.step.estimate = estimate;
    o.step.control = StepControl::kPaper;
    o.step.h = 0.125;
    o.step.h_max = 0.125;
    o.newton.kind = NewtonKind::kModified;
    o.predictor = Predictor::kAcceleration;
    const auto all = taken(Decay{}, decayStart(), 1, o, "radau_iia_2").solution;
    ASSERT_EQ(all.outcome, Outcome::kSuccess);
    EXPECT_EQ(all.counters.steps_accepted, 8) << idOf(estimate);
    EXPECT_EQ(all.counters.newton_iterations, 24) << idOf(estimate);
    // `richardson` looks between the stages of each half step: at one point for each hundredth of the interval that it
    // lasts, 7 of 0.0625, and at its start. The first of them and the start, where the defect is largest, are filtered,
    // the others only where they are larger than those before.
    const bool looks = estimate == ErrorEstimate::kRichardson;
    EXPECT_EQ(all.counters.solves, 24) << idOf(estimate);
    EXPECT_GE(all.counters.filter_solves, looks ? 16 * 2 : 0) << idOf(estimate);
    EXPECT_LT(all.counters.filter_solves, looks ? 16 * (7 + 1) : 1) << idOf(estimate);
    EXPECT_EQ(all.counters.factorizations, 2) << idOf(estimate);
    // Two stages have no real eigenvalue, so that `richardson` factorizes the filter of its looks by itself.
    EXPECT_EQ(all.counters.filter_factorizations, looks ? 1 : 0) << idOf(estimate);
    EXPECT_EQ(all.counters.jacobians, kOfStart + 1) << idOf(estimate);
  }
}

}  // namespace
}  // namespace irk::test
