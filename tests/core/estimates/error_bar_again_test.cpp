// Which error bars are measured again by a third integration, and what the two bars give together.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/error_bar_run.h"

namespace irk::test {
namespace {

// Whether the bar of a result at t = 1 that is wrong by `error` is measured again.
bool isMeasuredAgain(double error, double tolerance, double offset = 0) {
  // A motion of 0.632 until t = 1.
  const FirstOrder decay{[offset](const auto& p) { return -(p.x[0] - offset); }};
  const auto start = startOf(decay, {.x = {offset + 1}});
  const auto result = startOf(decay, {.t = 1, .x = {offset + std::exp(-1) + error}});
  const auto options = adaptive(tolerance);
  auto second = secondOf(makeSystem<double>(decay), options);
  Solution<double> other;
  return asksForStricter(measureErrorBar(result, second, start, options.tolerances, {}, other));
}

// Only errors that have grown to the size of the motion leave the second integration as wrong as the first.
TEST(ErrorBar, AsksForAStricterIntegrationIfItIsLargeBesideTheMotion) {
  EXPECT_FALSE(isMeasuredAgain(1e-4, 1e-6)) << "70 tolerances";
  EXPECT_FALSE(isMeasuredAgain(0.06, 1e-3)) << "a tenth is 0.063";
  EXPECT_TRUE(isMeasuredAgain(0.07, 1e-3));
  EXPECT_FALSE(isMeasuredAgain(0.07, 1e-2)) << "5 tolerances";
  EXPECT_TRUE(isMeasuredAgain(0.2, 1e-2));
  EXPECT_FALSE(isMeasuredAgain(-0.03, 1e-3, 0.03 - std::exp(-1))) << "a result of 0 is not infinitely wrong";
  EXPECT_TRUE(isMeasuredAgain(0.5, 1e-5, 1000)) << "the size of the motion, but 0.05 % of its values";
  EXPECT_FALSE(isMeasuredAgain(0.2, 1e-3, 1000)) << "less than a tolerance";
  ErrorBar unknown;
  unknown.part_of_motion = 1;
  unknown.problem = "failed";
  EXPECT_FALSE(asksForStricter(unknown));
}

// After ten periods the oscillator is at its start again. u goes as far as 2 from it, v as far as 10.
TEST(ErrorBar, TheMotionOfAComponentIsItsLargestDistanceFromTheStart) {
  const SecondOrder oscillator{[](const auto& p) { return -100.0 * p.u[0]; }};
  const auto again = [&](double error_u, double error_v) {
    const auto start = startOf(oscillator, {.u = {1}});
    const auto result = startOf(oscillator, {.t = 2 * std::acos(-1.0), .u = {1 + error_u}, .v = {error_v}});
    const auto options = adaptive(1e-3);
    auto second = secondOf(makeSystem<double>(oscillator), options);
    Solution<double> other;
    return asksForStricter(measureErrorBar(result, second, start, options.tolerances, {}, other));
  };
  EXPECT_FALSE(again(0.1, 0));
  EXPECT_TRUE(again(0.3, 0));
  EXPECT_FALSE(again(0, 0.5));
  EXPECT_TRUE(again(0, 1.5));
}

TEST(ErrorBar, TheLargerOneIsTakenComponentByComponent) {
  ErrorBar a, b;
  a.u = Vec<double>::Constant(1, 3), b.u = Vec<double>::Constant(1, 2);
  a.v = Vec<double>::Constant(1, 0.25), b.v = Vec<double>::Constant(1, 0.5);
  a.x = (Vec<double>(2) << 1, 0).finished(), b.x = (Vec<double>(2) << 0, 7).finished();
  a.z = b.z = Vec<double>::Zero(0);
  a.tolerances = 30, a.part_of_motion = 0.2, a.worst = 0, a.remark = "of a";
  b.tolerances = 70, b.part_of_motion = 0.1, b.worst = 3;
  for (const ErrorBar& bar : {larger(a, b), larger(b, a)}) {
    EXPECT_EQ(bar.u[0], 3);
    EXPECT_EQ(bar.v[0], 0.5);
    EXPECT_EQ(bar.x[0], 1);
    EXPECT_EQ(bar.x[1], 7);
    EXPECT_EQ(bar.tolerances, 70);
    EXPECT_EQ(bar.part_of_motion, 0.2);
    EXPECT_EQ(bar.worst, 3);
    EXPECT_EQ(bar.remark, "of a");
  }
}

}  // namespace
}  // namespace irk::test
