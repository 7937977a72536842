// The paper's stopping rule (3.2) alone, beside the rule that also ends at round-off.
#include <gtest/gtest.h>

#include "tests/core/support.h"

namespace irk::test {
namespace {

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
