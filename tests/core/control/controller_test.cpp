// The controllers of the step size, checked number by number.
#include "core/control/controller.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace irk {
namespace {

StepOptions controlled(StepControl control) {
  StepOptions o;
  o.control = control;
  return o;
}

std::unique_ptr<StepController> paperRule(int p) { return makeController(controlled(StepControl::kPaper), p); }

TEST(Paper, KeepsTheStepUnlessItChangesByTwo) {
  const auto controller = paperRule(3);  // f = (1 / (4 eps))^(1/4)
  // f = 1.99: kept. f = 1 at eps = 1/4.
  EXPECT_EQ(controller->decide(0.25 / std::pow(1.99, 4), 0.1).h, 0.1);
  EXPECT_EQ(controller->decide(0.25, 0.1).h, 0.1);
  // eps = 0.9: accepted, f = 0.73: kept.
  const auto close = controller->decide(0.9, 0.1);
  EXPECT_TRUE(close.accept);
  EXPECT_EQ(close.h, 0.1);
}

TEST(Paper, GrowsByTheFormulaUpToFive) {
  const double eps = 0.25 / std::pow(3.0, 4);  // f = 3, eps < 1/16
  EXPECT_NEAR(paperRule(3)->decide(eps, 0.1).h, 0.3, 1e-12);
  EXPECT_NEAR(paperRule(3)->decide(1e-12, 0.1).h, 0.5, 1e-12);
  EXPECT_NEAR(paperRule(3)->decide(0, 0.1).h, 0.5, 1e-12);
}

TEST(Paper, RepeatsAboveTheTolerance) {
  const auto slightly = paperRule(3)->decide(1.01, 0.1);
  EXPECT_FALSE(slightly.accept);
  EXPECT_NEAR(slightly.h, 0.05, 1e-15);  // f = 0.705, but a change is at least by two
  const auto far = paperRule(3)->decide(1e3, 0.1);
  EXPECT_FALSE(far.accept);
  EXPECT_NEAR(far.h, 0.1 * std::pow(4e3, -0.25), 1e-12);
  EXPECT_FALSE(paperRule(3)->decide(std::nextafter(1.0, 2.0), 0.1).accept);
  EXPECT_TRUE(paperRule(3)->decide(1.0, 0.1).accept);
}

TEST(Paper, WithoutGammaItDoesNotFollowTheError) {
  StepOptions rules = controlled(StepControl::kPaper);
  rules.control.id = "paper_no_gamma";
  const auto controller = makeController(rules, 3);
  controller->decide(0.5, 0.1);
  EXPECT_EQ(controller->decide(0.5 / 8 * 0.95, 0.05).h, 0.05);
  EXPECT_NEAR(controller->decide(0.04, 0.05).h, 0.05, 1e-12);  // f = 1.58 as with gamma = 1
  EXPECT_NEAR(controller->decide(1e-3, 0.05).h, 0.05 * std::pow(250, 0.25), 1e-12);
}

// How many accepted steps follow a failure of size 0.1 before one asks for that size again. `keeps_first`: the first
// one keeps its size.
int stepsBelowTheFailedSize(StepController& controller, bool keeps_first) {
  EXPECT_NEAR(controller.afterFailure(0.1), 0.05, 1e-15);
  double h = 0.05;
  for (int steps = 0; steps < 100; ++steps) {
    h = controller.decide(1e-9, h).h;
    if (h >= 0.1) return steps;
    EXPECT_NEAR(h, steps == 0 && keeps_first ? 0.05 : 0.09, 1e-15) << "nine tenths of it are allowed";
  }
  return 100;
}

TEST(Paper, DoesNotReturnAtOnceToAStepForWhichNewtonFailed) {
  EXPECT_EQ(stepsBelowTheFailedSize(*paperRule(3), false), 9);
}

TEST(Paper, KeepsASizeBetweenNineTenthsOfTheFailedOneAndIt) {
  const auto controller = paperRule(3);
  controller->afterFailure(0.1);
  EXPECT_EQ(controller->decide(1e-9, 0.095).h, 0.095) << "the size neither grows nor shrinks";
}

TEST(Paper, UsesItsOptions) {
  StepOptions o = controlled(StepControl::kPaper);
  o.s_min = 3;
  o.change_at_least = 1.5;
  o.growth_at_most = 2.5;
  const auto fresh = [&] { return makeController(o, 1); };
  EXPECT_NEAR(fresh()->decide(1 / 9.01, 0.1).h, 0.1 * std::sqrt(9.01 / 3), 1e-13);
  EXPECT_EQ(fresh()->decide(1 / 8.99, 0.1).h, 0.1) << "s_max = s_min^2";
  EXPECT_NEAR(fresh()->decide(1e-9, 0.1).h, 0.25, 1e-15);
  EXPECT_NEAR(fresh()->decide(1.01, 0.1).h, 0.1 * std::sqrt(1 / 3.03), 1e-13);
  EXPECT_NEAR(fresh()->afterFailure(0.1), 0.1 / 1.5, 1e-15);
  EXPECT_NEAR(fresh()->decide(1e6, 0.1).h, 0.1 * std::sqrt(1 / 3e6), 1e-15) << "the paper has no bound";
}

TEST(Paper, ForgetsGammaAtARestartAndAtAnotherOrder) {
  const double plain = 0.05 * std::pow(1 / (4 * 1e-2), 1.0 / 4);  // grows: below 1/16, f = 2.2
  const auto damped = [] {
    auto controller = paperRule(3);
    (void)controller->decide(0.5, 0.1);
    // The halved step's error falls by 2^3 / 0.95: gamma = 0.95.
    EXPECT_EQ(controller->decide(0.5 / 8 * 0.95, 0.05).h, 0.05);
    return controller;
  };
  EXPECT_NEAR(damped()->decide(1e-2, 0.05).h, 0.95 * plain, 1e-12);
  const auto restarted = damped();
  restarted->forget();
  EXPECT_NEAR(restarted->decide(1e-2, 0.05).h, plain, 1e-12);
  const auto elsewhere = damped();
  elsewhere->forget();
  EXPECT_NEAR(elsewhere->decide(1e-2, 0.04).h, 0.8 * plain, 1e-12) << "another step: no gamma";
  const auto failed = paperRule(3);
  failed->afterFailure(0.1);
  failed->forget();
  EXPECT_NEAR(failed->decide(1e-9, 0.05).h, 0.25, 1e-12) << "a restart knows of no failure";
  const auto changed = damped();
  changed->changeOrder(1, 0.5, 0.05);
  EXPECT_NEAR(changed->decide(1e-2, 0.05).h, 0.05 * 5, 1e-12);  // f = 5
}

// The later source of the paper's controller: f = (1 / (2 eps))^(1/p), growth only below 1 / 4, no gamma.
TEST(Hotint, HasItsOwnExponentAndSafety) {
  const auto fresh = [](int p) { return makeController(controlled(StepControl::kHotint), p); };
  EXPECT_NEAR(fresh(2)->decide(0.05, 0.1).h, 0.1 * std::sqrt(10.0), 1e-13);
  EXPECT_NEAR(fresh(3)->decide(0.02, 0.1).h, 0.1 * std::cbrt(25.0), 1e-13);
  EXPECT_NEAR(fresh(1)->decide(0.2499, 0.1).h, 0.1 / (2 * 0.2499), 1e-15) << "just below 1 / s_max";
  EXPECT_EQ(fresh(1)->decide(0.25, 0.1).h, 0.1) << "not below 1 / s_max";
  const auto rejected = fresh(2)->decide(8, 0.1);
  EXPECT_FALSE(rejected.accept);
  EXPECT_NEAR(rejected.h, 0.1 / 4, 1e-15);
  // No gamma: the decision does not depend on history.
  const auto controller = fresh(2);
  (void)controller->decide(0.9, 0.2);
  EXPECT_NEAR(controller->decide(0.05, 0.1).h, 0.1 * std::sqrt(10.0), 1e-13);
  controller->changeOrder(3, 0.5, 0.1);
  EXPECT_NEAR(controller->decide(0.02, 0.1).h, 0.1 * std::cbrt(25.0), 1e-13);
}

std::unique_ptr<StepController> predictiveRule(int p) {
  return makeController(controlled(StepControl::kPredictive), p);
}

// HW II (IV.8.25): h_new = 0.9 h eps^(-1/(p+1)) (h / h_old) (eps_old / eps)^(1/(p+1)), if that is less than the value
// without the two ratios.
double gustafsson(int p, double error, double h, double error_before, double h_before) {
  const double root = 1.0 / (p + 1);
  const double trend = h / h_before * std::pow(error_before / error, root);
  return 0.9 * h * std::pow(error, -root) * std::min(1.0, trend);
}

TEST(Predictive, FollowsGustafssonWhereStepAndErrorChange) {
  struct Step {
    double error, h;
  };
  // Steps and errors that shrink and grow: inverting either ratio would change the result.
  const Step sequences[][3] = {{{0.5, 0.1}, {0.3, 0.07}, {0.6, 0.09}},
                               {{0.2, 0.1}, {0.7, 0.12}, {0.9, 0.05}},
                               {{0.9, 0.02}, {0.5, 0.015}, {0.8, 0.03}}};
  for (const int p : {1, 3, 5}) {
    for (const auto& steps : sequences) {
      const auto controller = predictiveRule(p);
      (void)controller->decide(steps[0].error, steps[0].h);
      for (int i = 1; i < 3; ++i) {
        const auto decision = controller->decide(steps[i].error, steps[i].h);
        const double wish = gustafsson(p, steps[i].error, steps[i].h, steps[i - 1].error, steps[i - 1].h);
        const double ratio = wish / steps[i].h;
        const double expected = ratio >= 1 && ratio <= 1.2 ? steps[i].h : wish;
        EXPECT_TRUE(decision.accept);
        EXPECT_NEAR(decision.h, expected, 1e-12 * expected) << "p = " << p << ", step " << i;
      }
    }
  }
}

// In the ratio of errors, errors below 1e-2 count as 1e-2 (ERRACC of RADAU). After a change of order the history of
// the new order is used.
TEST(Predictive, BoundsOldErrorsFromBelowAndKeepsAHistoryPerOrder) {
  auto controller = predictiveRule(3);
  (void)controller->decide(1e-9, 0.1);
  EXPECT_NEAR(controller->decide(0.9, 0.08).h, gustafsson(3, 0.9, 0.08, 1e-2, 0.1), 1e-12);
  controller = predictiveRule(3);
  (void)controller->decide(0.4, 0.1);
  controller->changeOrder(5, 0.2, 0.05);
  EXPECT_NEAR(controller->decide(0.6, 0.04).h, gustafsson(5, 0.6, 0.04, 0.2, 0.05), 1e-12);
  controller->changeOrder(5, 1e-9, 0.05);
  EXPECT_NEAR(controller->decide(0.6, 0.04).h, gustafsson(5, 0.6, 0.04, 1e-2, 0.05), 1e-12);
  controller->forget();
  EXPECT_NEAR(controller->decide(0.9, 0.04).h, 0.9 * 0.04 * std::pow(0.9, -1.0 / 6), 1e-14) << "no trend";
}

TEST(Predictive, KeepsStepsLongerWhereFactorsAreExpensive) {
  // The cost of a factorization in steps, and the growth up to which the step size is then kept.
  for (const auto& [cost, up_to] : {std::pair{0.0, 1.2}, {1.0, 1.2}, {1.7, 1.7}, {2.0, 2.0}, {100.0, 2.0}}) {
    for (const double growth : {up_to - 0.02, up_to + 0.02}) {
      const auto controller = predictiveRule(3);
      controller->factorsCost(cost);
      const double error = std::pow(0.9 / growth, 4);
      EXPECT_NEAR(controller->decide(error, 0.1).h, growth < up_to ? 0.1 : 0.1 * growth, 1e-12) << cost;
    }
    // A smaller step is taken at any cost.
    const auto controller = predictiveRule(3);
    controller->factorsCost(cost);
    EXPECT_LT(controller->decide(0.9, 0.1).h, 0.099) << cost;
  }
  const auto rule = paperRule(3);
  rule->factorsCost(100);
  EXPECT_NEAR(rule->decide(0.25 / std::pow(2.1, 4), 0.1).h, 0.21, 1e-12) << "the paper's rule knows no costs";
}

TEST(Predictive, DoesNotRepeatAtOnceAStepForWhichNewtonFailed) {
  const auto controller = predictiveRule(3);
  EXPECT_EQ(stepsBelowTheFailedSize(*controller, true), 9);
  controller->afterFailure(0.1);
  controller->forget();
  EXPECT_GT(controller->decide(1e-6, 0.05).h, 0.1) << "a restart knows of no failure";
}

// Before the first accepted step the guess of the step size may be wrong by orders of magnitude. After an accepted
// step, and after a single failure, it is assumed to be nearly right.
TEST(Predictive, ShrinksTheFirstStepFastAfterRepeatedFailures) {
  const auto controller = predictiveRule(3);
  for (int start = 0; start < 2; ++start) {
    EXPECT_NEAR(controller->afterFailure(0.1), 0.05, 1e-15);
    EXPECT_NEAR(controller->afterFailure(0.05), 0.01, 1e-15);
    EXPECT_NEAR(controller->afterFailure(0.01), 0.002, 1e-15);
    EXPECT_TRUE(controller->decide(0.5, 0.002).accept);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(controller->afterFailure(0.1), 0.05, 1e-15);
    controller->forget();
  }
}

TEST(Predictive, DoesNotJumpOverTheSmallestStep) {
  auto options = controlled(StepControl::kPredictive);
  options.h_min = 1e-3;
  const auto controller = makeController(options, 3);
  EXPECT_NEAR(controller->afterFailure(1e-2), 5e-3, 1e-15);
  EXPECT_NEAR(controller->afterFailure(5e-3), 1e-3, 1e-15);
}

TEST(Predictive, RejectsAndThenDoesNotGrowAtOnce) {
  const auto controller = predictiveRule(3);
  const auto rejected = controller->decide(std::pow(2.0, 4), 0.1);
  EXPECT_FALSE(rejected.accept);
  EXPECT_NEAR(rejected.h, 0.045, 1e-14);
  EXPECT_EQ(controller->decide(1e-8, 0.045).h, 0.045);
  EXPECT_NEAR(controller->decide(1e-8, 0.045).h, 8 * 0.045, 1e-14);
}

}  // namespace
}  // namespace irk
