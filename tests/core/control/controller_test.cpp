// The paper's step-size controller (section 6), checked number by number.
#include <gtest/gtest.h>

#include <cmath>

#include "core/control/controller.h"

namespace irk {
namespace {

StepOptions paperRules() {
  StepOptions options;
  options.control = StepControl::kPaper;
  return options;
}

TEST(PaperController, KeepsTheStepUnlessItChangesByTwo) {
  const auto controller = makeController(paperRules(), 3);  // f = (1 / (4 eps))^(1/4)
  // f = 1.99: kept. f = 1 at eps = 1/4.
  EXPECT_EQ(controller->decide(0.25 / std::pow(1.99, 4), 0.1).h, 0.1);
  EXPECT_EQ(controller->decide(0.25, 0.1).h, 0.1);
  // eps = 0.9: accepted, f = 0.73: kept.
  const auto close = controller->decide(0.9, 0.1);
  EXPECT_TRUE(close.accept);
  EXPECT_EQ(close.h, 0.1);
}

TEST(PaperController, GrowsByTheFormulaUpToFive) {
  const double eps = 0.25 / std::pow(3.0, 4);  // f = 3, eps < 1/16
  EXPECT_NEAR(makeController(paperRules(), 3)->decide(eps, 0.1).h, 0.3, 1e-12);
  EXPECT_NEAR(makeController(paperRules(), 3)->decide(1e-12, 0.1).h, 0.5, 1e-12);
  EXPECT_NEAR(makeController(paperRules(), 3)->decide(0, 0.1).h, 0.5, 1e-12);
}

TEST(PaperController, GrowsOnlyBelowOneOverSMax) {
  // p = 1: f = 2 needs eps = 1/16 = 1/s_max: not below it.
  EXPECT_EQ(makeController(paperRules(), 1)->decide(1.0 / 16, 0.1).h, 0.1);
  EXPECT_NEAR(makeController(paperRules(), 1)->decide(1.0 / 17, 0.1).h, 0.1 * std::sqrt(17.0 / 4), 1e-12);
}

TEST(PaperController, RepeatsAboveTheTolerance) {
  const auto slightly = makeController(paperRules(), 3)->decide(1.01, 0.1);
  EXPECT_FALSE(slightly.accept);
  EXPECT_NEAR(slightly.h, 0.05, 1e-15);  // f = 0.705, but a change is at least by two
  const auto far = makeController(paperRules(), 3)->decide(1e3, 0.1);
  EXPECT_FALSE(far.accept);
  EXPECT_NEAR(far.h, 0.1 * std::pow(4e3, -0.25), 1e-12);
  EXPECT_FALSE(makeController(paperRules(), 3)->decide(std::nextafter(1.0, 2.0), 0.1).accept);
  EXPECT_TRUE(makeController(paperRules(), 3)->decide(1.0, 0.1).accept);
}

TEST(PaperController, GammaFollowsTheErrorAfterAChangeOfStep) {
  const auto controller = makeController(paperRules(), 3);
  controller->decide(0.5, 0.1);
  // The halved step's error fell by 2^3 / 0.95: gamma = 0.95; f = 0.95 (1 / (4 eps))^(1/4).
  const double eps = 0.5 / 8 * 0.95;
  EXPECT_EQ(controller->decide(eps, 0.05).h, 0.05);
  EXPECT_NEAR(controller->decide(1e-4, 0.05).h, 0.05 * std::min(5.0, 0.95 * std::pow(2500, 0.25)), 1e-12);
}

TEST(PaperController, WithoutGammaItDoesNotFollowTheError) {
  StepOptions rules = paperRules();
  rules.control.id = "paper_no_gamma";
  const auto controller = makeController(rules, 3);
  controller->decide(0.5, 0.1);
  EXPECT_EQ(controller->decide(0.5 / 8 * 0.95, 0.05).h, 0.05);
  EXPECT_NEAR(controller->decide(0.04, 0.05).h, 0.05, 1e-12);  // f = 1.58 as with gamma = 1
  EXPECT_NEAR(controller->decide(1e-3, 0.05).h, 0.05 * std::pow(250, 0.25), 1e-12);
}

TEST(PaperController, HalvesAfterAFailedNewton) {
  EXPECT_NEAR(makeController(paperRules(), 3)->afterFailure(0.1), 0.05, 1e-15);
}

TEST(PaperController, DoesNotReturnAtOnceToAStepForWhichNewtonFailed) {
  const auto controller = makeController(paperRules(), 3);
  EXPECT_NEAR(controller->afterFailure(0.1), 0.05, 1e-15);
  int kept = 0;
  while (controller->decide(1e-9, 0.05).h == 0.05) ++kept;
  EXPECT_EQ(kept, 9);
}

StepOptions predictive() {
  StepOptions o;
  o.control = StepControl::kPredictive;
  return o;
}

TEST(PredictiveController, FollowsTheFormula) {
  const auto controller = makeController(predictive(), 3);
  // No history: h_new = 0.9 h eps^(-1/4).
  EXPECT_NEAR(controller->decide(std::pow(0.5, 4), 0.1).h, 0.18, 1e-14);
  // The error grew by 2^4 over the same step: half of the plain proposal 0.9.
  EXPECT_NEAR(controller->decide(1, 0.1).h, 0.045, 1e-14);
  // It fell: the plain proposal stands; between 1 and 1.2 the step is kept.
  EXPECT_EQ(controller->decide(std::pow(0.8, 4), 0.1).h, 0.1);
}

TEST(PredictiveController, RejectsAndThenDoesNotGrowAtOnce) {
  const auto controller = makeController(predictive(), 3);
  const auto rejected = controller->decide(std::pow(2.0, 4), 0.1);
  EXPECT_FALSE(rejected.accept);
  EXPECT_NEAR(rejected.h, 0.045, 1e-14);
  EXPECT_EQ(controller->decide(1e-8, 0.045).h, 0.045);
  EXPECT_NEAR(controller->decide(1e-8, 0.045).h, 8 * 0.045, 1e-14);
}

}  // namespace
}  // namespace irk
