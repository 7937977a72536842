// The estimate by embedded weights of a tableau: its size and order, stiff and constrained systems, what it refuses.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/core/support.h"
#include "tests/refusal.h"

namespace irk::test {
namespace {

/// HW II, table IV.6.5: order 4, embedded order 3, A-stable, A invertible.
Tableau<double> sdirk4() {
  Tableau<double> t;
  t.id = "sdirk4", t.family = "user", t.order = 4, t.stage_order = 1, t.order_hat = 3;
  t.A = Mat<double>::Zero(5, 5);
  t.A.row(0) << 1. / 4, 0, 0, 0, 0;
  t.A.row(1) << 1. / 2, 1. / 4, 0, 0, 0;
  t.A.row(2) << 17. / 50, -1. / 25, 1. / 4, 0, 0;
  t.A.row(3) << 371. / 1360, -137. / 2720, 15. / 544, 1. / 4, 0;
  t.A.row(4) << 25. / 24, -49. / 48, 125. / 16, -85. / 12, 1. / 4;
  t.b = t.A.row(4);
  t.c = t.A.rowwise().sum();
  t.b_hat.resize(5);
  t.b_hat << 59. / 48, -17. / 96, 225. / 32, -85. / 12, 0;
  return t;
}

/// TR-BDF2 of M. E. Hosea, L. F. Shampine, Appl. Numer. Math. 20 (1996): order 2, explicit first stage, weights of
/// order 3 whose R is unbounded.
Tableau<double> trBdf2() {
  const double d = 1 - std::sqrt(0.5), w = std::sqrt(2.0) / 4;
  Tableau<double> t;
  t.id = "tr_bdf2", t.family = "user", t.order = 2, t.stage_order = 2, t.order_hat = 3;
  t.A = Mat<double>::Zero(3, 3);
  t.A.row(1) << d, d, 0;
  t.A.row(2) << w, w, d;
  t.b = t.A.row(2);
  t.c = t.A.rowwise().sum();
  t.b_hat.resize(3);
  t.b_hat << (1 - w) / 3, (3 * w + 1) / 3, d / 3;
  return t;
}

IntegratorOptions withWeights(double tolerance) {
  IntegratorOptions o = adaptive(tolerance);
  o.step.estimate = parseId<ErrorEstimate>("tableau");
  return o;
}

template <class P>
Solution<double> byTableau(const P& problem, const State<double>& start, double t_end, const Tableau<double>& method,
                           double tolerance, double* first_error = nullptr, double h = 0) {
  IntegratorOptions options = withWeights(tolerance);
  options.step.h = h;
  Integrator<double> integrator(makeSystem<double>(problem), method, options);
  Monitor<double> monitor;
  bool first = true;
  monitor.accepted = [&](const StepRecord<double>& step) {
    if (first && first_error) *first_error = step.error * tolerance;
    first = false;
  };
  return integrator.integrate(start, t_end, monitor);
}

// The estimate of one step has the leading term h^(p+1), p the lower of the two orders.
void expectOrder(const Tableau<double>& method, int p) {
  double coarse = 0, fine = 0;
  const double h = 0.02;
  ASSERT_EQ(byTableau(Riccati{}, riccatiStart<double>(), h, method, 1, &coarse, h).outcome, Outcome::kSuccess);
  ASSERT_EQ(byTableau(Riccati{}, riccatiStart<double>(), h / 2, method, 1, &fine, h / 2).outcome, Outcome::kSuccess);
  EXPECT_NEAR(std::log2(coarse / fine), p + 1, 0.25) << method.id;
}
TEST(TableauWeights, TheEstimateHasTheLowerOrder) {
  expectOrder(sdirk4(), 3);
  expectOrder(trBdf2(), 2);
}

TEST(TableauWeights, TheErrorFollowsTheTolerance) {
  for (const auto& method : {sdirk4(), trBdf2()}) {
    for (const double tolerance : {1e-4, 1e-7}) {
      const auto solution = byTableau(Riccati{}, riccatiStart<double>(), 3, method, tolerance);
      ASSERT_EQ(solution.outcome, Outcome::kSuccess) << method.id << ": " << solution.detail;
      // Each step errs by a tolerance at most, in a norm with the weight 1 + |x|, and the equation damps.
      const double most = 3.5 * tolerance * static_cast<double>(solution.counters.steps_accepted);
      EXPECT_LT(std::abs(solution.state.x[0] - 1.5 - std::sin(3.0)), most) << method.id;
    }
  }
}

// Without the filter the estimate of TR-BDF2 is h lambda times that of a component that has no error: some thousand
// steps.
TEST(TableauWeights, AreFilteredForStiffComponents) {
  // x = cos t: HW II, Prothero & Robinson.
  const FirstOrder stiff{[](const auto& p) {
    using std::cos;
    using std::sin;
    return -1e6 * (p.x[0] - cos(p.t)) - sin(p.t);
  }};
  for (const auto& method : {sdirk4(), trBdf2()}) {
    const auto solution = byTableau(stiff, startOf(stiff, {.x = {1}}), 10, method, 1e-4);
    ASSERT_EQ(solution.outcome, Outcome::kSuccess) << method.id << ": " << solution.detail;
    EXPECT_NEAR(solution.state.x[0], std::cos(10.0), 1e-3) << method.id;
    EXPECT_LT(solution.counters.steps_accepted, 200) << method.id;
  }
}

TEST(TableauWeights, EstimateConstrainedMotions) {
  const auto accurate = integrate<double>(CartesianPendulum{}, pendulumStart<double>(), 1,
                                          makeTableau<double>("radau_iia_5"), adaptive(1e-11));
  const auto solution = byTableau(CartesianPendulum{}, pendulumStart<double>(), 1, sdirk4(), 1e-6);
  ASSERT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
  EXPECT_LT((solution.state.u - accurate.state.u).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LT(solution.counters.steps_accepted, 1000);
}

TEST(TableauWeights, AreRefusedByNameWhereThereAreNone) {
  const auto refused = [](const Tableau<double>& method) {
    return refusal([&] { Integrator<double>(makeSystem<double>(Riccati{}), method, withWeights(1e-6)); });
  };
  EXPECT_TRUE(contains(refused(makeTableau<double>("radau_iia_3")),
                       "estimate 'tableau' with method 'radau_iia_3': it has no embedded"));
  Tableau<double> singular = sdirk4();
  singular.A(2, 2) = 0;
  EXPECT_TRUE(contains(refused(singular), "its A is singular"));
}

}  // namespace
}  // namespace irk::test
