// The Newton methods that keep their Jacobian by rule: counted Jacobians.
#include <gtest/gtest.h>

#include <cstddef>
#include <string_view>

#include "tests/core/support.h"
#include "tests/core/watched.h"

namespace irk::test {
namespace {

// Jacobians of the consistent start.
constexpr int kOfStart = 1;

NewtonKind newtonNamed(std::string_view id) { return parseId<NewtonKind>(id); }

template <class P>
Taken stepsOf(const P& problem, double x0, double t_end, std::string_view newton, IntegratorOptions o) {
  o.newton.kind = newtonNamed(newton);
  const Taken all = taken(problem, startOf(problem, {.x = {x0}}), t_end, o);
  EXPECT_EQ(all.solution.outcome, Outcome::kSuccess) << newton;
  return all;
}

// Three steps of 0.3 and one of 0.1. The problem is linear: no iteration asks for another Jacobian.
TEST(ReuseByStep, CountsTheJacobiansOfFixedSteps) {
  const auto jacobians = [](std::string_view newton) {
    return stepsOf(Decay{}, 1, 1, newton, fixedSteps(0.3)).solution.counters.jacobians;
  };
  EXPECT_EQ(jacobians("modified"), kOfStart + 1);
  EXPECT_EQ(jacobians("modified_each_step"), kOfStart + 4);
  EXPECT_EQ(jacobians("modified_step_change"), kOfStart + 3)
      << "the last step is shorter and keeps that of the one before";
  EXPECT_EQ(jacobians("broyden_each_step"), kOfStart + 4);
  EXPECT_EQ(jacobians("broyden_step_change"), kOfStart + 3);
}

// With step doubling: both half steps work with the Jacobian of their attempt, and an attempt whose size is not that of
// the one before keeps the former Jacobian.
TEST(ReuseByStep, CountsAttemptsOfChangingSteps) {
  // The Jacobian changes along the solution, and so do the steps.
  const FirstOrder logistic{[](const auto& p) { return 5.0 * p.x[0] * (1.0 - p.x[0]); }};
  for (const std::string_view method : {"modified", "broyden"}) {
    IntegratorOptions o = adaptive(1e-6);
    o.step.control = StepControl::kPaper;
    o.step.estimate = ErrorEstimate::kDoubling;
    o.step.h = 1e-3;
    const std::string name(method);
    const Taken each = stepsOf(logistic, 0.01, 3, name + "_each_step", o);
    const Taken change = stepsOf(logistic, 0.01, 3, name + "_step_change", o);
    const auto& c = each.solution.counters;
    const auto attempts = c.steps_accepted + c.steps_rejected_error + c.steps_rejected_newton;
    EXPECT_EQ(c.jacobians, kOfStart + attempts + c.newton_restarts) << name;
    EXPECT_EQ(c.newton_restarts, 0) << name;

    const auto& d = change.solution.counters;
    ASSERT_EQ(d.steps_rejected_error + d.steps_rejected_newton, 0) << "else attempts are not the steps below";
    std::int64_t changes = 0;
    for (std::size_t i = 1; i < change.h.size(); ++i) changes += change.h[i] != change.h[i - 1] ? 1 : 0;
    EXPECT_GT(changes, 2) << name;
    EXPECT_LT(changes + 2, d.steps_accepted) << name;
    EXPECT_EQ(d.jacobians, kOfStart + d.steps_accepted - changes + d.newton_restarts) << name;
    EXPECT_NEAR(change.solution.state.x[0], each.solution.state.x[0], 1e-5) << name;
  }
}

}  // namespace
}  // namespace irk::test
