// Where Newton's method stops: with fixed steps at round-off, so that errors are those of the scheme; the paper's
// stopping rule (3.2) alone does not.
#include <gtest/gtest.h>

#include <string>

#include "core/newton/newton.h"
#include "tests/core/support.h"

namespace irk::test {
namespace {

Vec<double> riccatiEnd(NewtonKind newton, double residual_tolerance) {
  IntegratorOptions o = fixedSteps(0.1);
  o.newton.kind = newton;
  o.newton.residual_tolerance = residual_tolerance;
  o.solver = StageSolverKind::kCoupledDense;
  const auto s = integrate<double>(Riccati{}, riccatiStart<double>(), 2, makeTableau<double>("radau_iia_3"), o);
  EXPECT_EQ(s.outcome, Outcome::kSuccess) << idOf(newton) << ": " << s.detail;
  return s.state.x;
}

// Two hundred round-off units after 20 steps. Ended at 1e-2, the paper's rule leaves 1e-9 and more.
TEST(FixedSteps, DoNotShowWhereNewtonsMethodEnds) {
  const Vec<double> exact = riccatiEnd(NewtonKind::kSimplified, 1e-10);
  for (const auto& method : catalogue<NewtonKind>().named()) {
    if (method.id == "paper_rule") continue;  // its rule alone ends the iteration
    for (const double tolerance : {1e-2, 1e-6, 1e-13}) {
      EXPECT_LT((riccatiEnd(method.value, tolerance) - exact).norm(), 200 * 2.2e-16 * exact.norm())
          << method.id << " " << tolerance;
    }
  }
  EXPECT_GT((riccatiEnd(parseId<NewtonKind>("paper_rule"), 1e-2) - exact).norm(), 1e-9) << "the test can fail";
}

// With an exponent that Newton's error would change: Gauss with 4 stages has order 8. Between h = 1 / 2 and 1 / 8 its
// error falls from some 1e-7 to some 1e-12.
TEST(FixedSteps, ShowTheOrderOfTheSchemeWithEveryNewton) {
  const auto end = [](NewtonKind newton, double h) {
    IntegratorOptions o = fixedSteps(h);
    o.newton.kind = newton;
    o.newton.residual_tolerance = 1e-3;
    o.solver = StageSolverKind::kCoupledDense;
    return integrate<double>(Riccati{}, riccatiStart<double>(), 2, makeTableau<double>("gauss_4"), o).state.x;
  };
  const Vec<double> exact = end(NewtonKind::kSimplified, 1.0 / 64);
  for (const auto newton : {NewtonKind::kSimplified, NewtonKind::kModified, NewtonKind::kFull}) {
    const auto errorOf = [&](double h) { return (end(newton, h) - exact).norm(); };
    EXPECT_NEAR(orderOf({1.0 / 2, 1.0 / 4, 1.0 / 8}, errorOf), 8, 0.5) << idOf(newton);
  }
}

Solution<double> riccati(const char* newton, double residual_tolerance, IntegratorOptions o = fixedSteps(0.1)) {
  o.newton.kind = parseId<NewtonKind>(newton);
  o.newton.residual_tolerance = residual_tolerance;
  return integrate<double>(Riccati{}, riccatiStart<double>(), 0.5, makeTableau<double>("radau_iia_3"), o);
}

// Five digits are within reach: both rules end in the same iterations where the step size follows a tolerance.
TEST(PaperRule, EqualsTheModifiedMethodAboveRoundOff) {
  const IntegratorOptions o = adaptive(1e-5);
  const auto modified = riccati("modified", 1e-5, o), rule = riccati("paper_rule", 1e-5, o);
  ASSERT_EQ(rule.outcome, Outcome::kSuccess) << rule.detail;
  EXPECT_EQ(rule.counters.newton_iterations, modified.counters.newton_iterations);
  EXPECT_EQ(rule.state.x, modified.state.x);
}

// A residual in double precision cannot shrink by 1e-30: `modified` ends at round-off, the rule alone never does. It
// begins again with a new Jacobian and with full Newton, as the paper says, and uses all iterations of the last try.
// Only a residual of exactly zero lets a step pass.
TEST(PaperRule, FailsWhereRoundOffIsReachedFirst) {
  const auto modified = riccati("modified", 1e-30), rule = riccati("paper_rule", 1e-30);
  ASSERT_EQ(modified.outcome, Outcome::kSuccess) << modified.detail;
  EXPECT_EQ(rule.outcome, Outcome::kNewtonFailed);
  EXPECT_LT(rule.counters.steps_accepted, 3);
  EXPECT_GE(rule.counters.newton_restarts, 1);
  EXPECT_GE(rule.counters.newton_iterations, 25);
}

}  // namespace
}  // namespace irk::test
