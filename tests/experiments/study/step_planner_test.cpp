#include "experiments/study/step_planner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "experiments/analyses/orders/order_fit.h"
#include "experiments/study/study.h"

namespace irk {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::vector<double> steps(int most) {
  std::vector<double> all;
  for (const int n : divisions(most)) all.push_back(1.0 / n);
  return all;
}

// The errors of x at the steps that the planner requests.
std::vector<ErrorPoint> planned(double epsilon, const std::function<double(double)>& error) {
  const auto candidates = steps(1024);
  StepPlanner planner(candidates, epsilon);
  std::vector<ErrorPoint> points;
  while (const auto i = planner.next()) {
    const double h = candidates[*i];
    points.push_back({h, std::max(error(h), 0.1 * epsilon)});
    planner.record(*i, {kNaN, kNaN, points.back().error, kNaN});
  }
  return points;
}

TEST(StepPlanner, ItsStepsShowOrdersFromNegativeToForty) {
  for (const double p : {-2.0, 0.0, 1.0, 5.0, 10.0, 19.0, 39.0}) {
    const auto points = planned(1e-100, [p](double h) { return std::pow(h, p) * (1 + 2 * h); });
    OrderFitOptions options;
    options.epsilon = 1e-100;
    const auto fit = fitOrder(points, options);
    ASSERT_TRUE(fit.measurable) << p << ": " << fit.reason;
    EXPECT_NEAR(fit.order, p, 0.1);
    EXPECT_LE(points.size(), 13u) << p;
  }
}

TEST(StepPlanner, RoundOffAndThePreAsymptoticRangeAreLeftAside) {
  // Slope 3 above h = 0.05, slope 6 below; round-off at 1e-16.
  const auto points = planned(1e-16, [](double h) { return std::pow(h, 6) / (1 + std::pow(h / 0.05, 3)); });
  const auto fit = fitOrder(points);
  ASSERT_TRUE(fit.measurable) << fit.reason;
  EXPECT_NEAR(fit.order, 6, 0.15);
}

TEST(StepPlanner, StopsAtRoundOffThatGrows) {
  // Order 20, down to round-off that grows as 1/h and stays above 1e3 epsilon.
  const auto points = planned(1e-50, [](double h) { return std::pow(h, 20) * (1 + h) + 1e-46 / h; });
  OrderFitOptions options;
  options.epsilon = 1e-50;
  const auto fit = fitOrder(points, options);
  ASSERT_TRUE(fit.measurable) << fit.reason;
  EXPECT_NEAR(fit.order, 20, 0.2);
  const auto finest = std::min_element(points.begin(), points.end(), [](auto& a, auto& b) { return a.h < b.h; });
  EXPECT_GT(finest->h, 1.0 / 600) << "no run far below the step at which the error stops shrinking";
}

TEST(StepPlanner, AStepBelowRoundOffIsPredictedAndNotMade) {
  const auto points = planned(1e-50, [](double h) { return std::pow(h, 20); });
  // The floor is 1e-47: it is reached at N = 224, between the probes.
  for (const auto& p : points) EXPECT_GT(p.h, 1.0 / 250);
}

TEST(StepPlanner, ComponentsShareTheirSteps) {
  const auto candidates = steps(1024);
  const auto runs = [&](bool all) {
    StepPlanner planner(candidates, 1e-50);
    std::size_t count = 0;
    while (const auto i = planner.next()) {
      const double h = candidates[*i], x = std::pow(h, 6) * (1 + h), z = std::pow(h, 3) * (1 + h);
      planner.record(*i, {all ? x : kNaN, all ? x : kNaN, x, all ? z : kNaN});
      ++count;
    }
    return count;
  };
  EXPECT_EQ(runs(true), runs(false)) << "the same range of steps";
}

TEST(StepPlanner, GoesOnPastFailuresAndStopsWhereToldSo) {
  const auto candidates = steps(64);
  StepPlanner planner(candidates, 1e-16);
  EXPECT_EQ(planner.next(), 0u);
  planner.recordFailure(0);
  const auto second = planner.next();
  ASSERT_TRUE(second);
  EXPECT_NEAR(candidates[*second], 0.25, 1e-12);
  planner.recordFailure(*second);
  planner.endProbe();
  EXPECT_FALSE(planner.next());
}

TEST(StepPlanner, MeasuresEveryComponentInItsOwnRange) {
  const auto candidates = steps(1024);
  StepPlanner planner(candidates, 1e-50);
  std::vector<double> asked;
  while (const auto i = planner.next()) {
    const double h = candidates[*i];
    asked.push_back(h);
    planner.record(*i, {std::pow(h, 20), kNaN, kNaN, h * (1 + 10 * h)});
  }
  const auto within = [&](double low, double high) {
    return std::count_if(asked.begin(), asked.end(), [&](double h) { return h >= low && h <= high; });
  };
  // The probe continues for z until 10 h is small; meanwhile h^20 falls to 1e-47 at h = 0.0045.
  EXPECT_GE(within(0.0044, 0.0195), 5);
  EXPECT_GE(within(0.0009, 0.007), 5);
}

TEST(StepPlanner, DivisionsAreEvenAndGrowByATenth) {
  EXPECT_EQ(divisions(30), (std::vector<int>{2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30}));
  const auto all = divisions(1000);
  for (std::size_t i = 20; i < all.size(); ++i) {
    EXPECT_EQ(all[i] % 2, 0);
    EXPECT_NEAR(static_cast<double>(all[i]) / all[i - 1], 1.1, 0.03);
  }
}

}  // namespace
}  // namespace irk
