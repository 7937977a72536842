// With fixed steps Newton's method goes on after an increment that is larger than the one before.
#include <gtest/gtest.h>

#include "tests/core/support.h"

namespace irk::test {
namespace {

/// y' = 6 t, x' = c y^2 from zero: y = 3 t^2, x = 9 c t^5 / 5. At the start x' does not depend on y. In the first step
/// with the Jacobian from there, the first increment is that of y' alone, the second one that of x' alone, and the
/// third is zero.
struct Hidden {
  double c;
  Sizes sizes() const { return {.nx = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = c * (p.x[1] * p.x[1]) - p.k[0];
    r.x[1] = 6 * p.t - p.k[1];
  }
};

constexpr double kPatienceStep = 0.1;

Solution<double> follow(double c, const IntegratorOptions& options) {
  return integrate<double>(Hidden{c}, State<double>(Hidden{c}.sizes()), kPatienceStep, makeTableau<double>("gauss_3"),
                           options);
}

// The second increment is about three times the first one.
TEST(Patience, OneLargerIncrementEndsNoFixedStep) {
  const auto solution = follow(2000, fixedSteps(kPatienceStep));
  ASSERT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
  EXPECT_NEAR(solution.state.x[0], 9 * 2000 * 1e-5 / 5, 1e-13);
  EXPECT_NEAR(solution.state.x[1], 0.03, 1e-15);
  EXPECT_EQ(solution.counters.newton_iterations, 3);
}

// Nor does one a hundred times the first: the third is zero here, too.
TEST(Patience, AMuchLargerIncrementEndsNone) {
  const auto solution = follow(1e5, fixedSteps(kPatienceStep));
  ASSERT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
  EXPECT_NEAR(solution.state.x[0], 9 * 1e5 * 1e-5 / 5, 1e-11);
}

/// x' = 1 + x^2 ends at pi / 2: the equations of a step beyond it have no solution.
struct Tangent {
  Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = 1.0 + p.x[0] * p.x[0] - p.k[0];
  }
};

TEST(Patience, EndsAtTheLimitOfIterations) {
  IntegratorOptions options = fixedSteps(4);
  options.newton.max_iterations = 8;
  const auto solution =
      integrate<double>(Tangent{}, State<double>(Tangent{}.sizes()), 4, makeTableau<double>("radau_iia_2"), options);
  EXPECT_TRUE(solution.outcome == Outcome::kNewtonFailed || solution.outcome == Outcome::kNotFinite);
  EXPECT_LE(solution.counters.newton_iterations, 4 * 8 * 2);
}

// A shorter step costs less than to go on.
TEST(Patience, IsNotForStepsThatCanBeShortened) {
  IntegratorOptions options = adaptive(1e-3);
  options.step.h = kPatienceStep;
  const auto solution = follow(2000, options);
  EXPECT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
  EXPECT_GT(solution.counters.steps_rejected_newton, 0);
}

}  // namespace
}  // namespace irk::test
