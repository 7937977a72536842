#include "experiments/analyses/orders/order_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace irk {
namespace {

// error(h) at h = 1/N; each N is a quarter larger than the last.
template <class F>
std::vector<ErrorPoint> series(int most, F&& error) {
  std::vector<ErrorPoint> points;
  for (int n = 1; n <= most; n = std::max(n + 1, static_cast<int>(std::lround(1.25 * n)))) {
    points.push_back({1.0 / n, error(1.0 / n)});
  }
  return points;
}

TEST(OrderFit, RecoversAnExactSlope) {
  for (const double p : {1.0, 3.0, 7.0, 13.0}) {
    const auto fit = fitOrder(series(200, [p](double h) { return 0.3 * std::pow(h, p); }));
    ASSERT_TRUE(fit.measurable) << fit.reason;
    EXPECT_NEAR(fit.order, p, 1e-9);
    EXPECT_LT(fit.confidence, 1e-8);
    EXPECT_GE(fit.points, 3);
  }
}

TEST(OrderFit, TellsNeighbouringOrdersApart) {
  // Half an order in each direction: a test of |order - 4| < 0.2 must fail for both.
  for (const double p : {3.5, 4.5}) {
    const auto fit = fitOrder(series(200, [p](double h) { return std::pow(h, p); }));
    ASSERT_TRUE(fit.measurable);
    EXPECT_GT(std::abs(fit.order - 4), 0.2);
  }
}

TEST(OrderFit, LeavesRoundOffOut) {
  // Noise around 1e-12: without a window above it the slope would be near 3.
  const auto fit =
      fitOrder(series(3000, [](double h) { return std::pow(h, 5) + 1e-12 * (1 + 0.5 * std::sin(1e4 * h)); }));
  ASSERT_TRUE(fit.measurable) << fit.reason;
  EXPECT_NEAR(fit.order, 5, 0.05);
  // The window ends above the noise: h^5 = 1e-11.
  EXPECT_GE(fit.h_min, std::pow(1e-11, 0.2));
}

TEST(OrderFit, LeavesThePreAsymptoticRangeOut) {
  // Local slopes fall from 4 to 2 around h = 0.1.
  const auto fit = fitOrder(series(3000, [](double h) { return h * h + 100 * std::pow(h, 4); }));
  ASSERT_TRUE(fit.measurable) << fit.reason;
  EXPECT_NEAR(fit.order, 2, 0.05);
  EXPECT_LT(fit.h_max, 0.05);
}

TEST(OrderFit, IsNotFooledByAnErrorThatIsAboutToChangeItsSign) {
  // Measured: radau_iia_9 on riccati_tracking in 50 digits. Order 17, slopes of 18.8 over 15
  // decades, and a zero near h = 0.035.
  const std::vector<ErrorPoint> points = {
      {2.0 / 1, 3.331e-12},   {2.0 / 2, 4.210e-17},   {2.0 / 3, 2.445e-20},   {2.0 / 4, 1.059e-22},
      {2.0 / 5, 1.551e-24},   {2.0 / 6, 4.977e-26},   {2.0 / 7, 2.740e-27},   {2.0 / 8, 2.234e-28},
      {2.0 / 9, 2.455e-29},   {2.0 / 10, 3.411e-30},  {2.0 / 12, 1.123e-31},  {2.0 / 14, 6.256e-33},
      {2.0 / 16, 5.114e-34},  {2.0 / 18, 5.593e-35},  {2.0 / 21, 3.058e-36},  {2.0 / 24, 2.432e-37},
      {2.0 / 28, 1.276e-38},  {2.0 / 32, 9.602e-40},  {2.0 / 37, 5.421e-41},  {2.0 / 43, 2.429e-42},
      {2.0 / 49, 1.242e-43},  {2.0 / 56, 4.410e-46},  {2.0 / 64, 1.033e-45},  {2.0 / 74, 1.711e-46},
      {2.0 / 85, 2.256e-47},  {2.0 / 98, 2.498e-48},  {2.0 / 113, 2.441e-49}, {2.0 / 130, 3.106e-50},
      {2.0 / 150, 1.331e-50}, {2.0 / 173, 3.550e-50}, {2.0 / 199, 4.881e-50}, {2.0 / 229, 3.106e-50}};
  OrderFitOptions options;
  options.epsilon = 1e-50;
  const auto fit = fitOrder(points, options);
  EXPECT_TRUE(!fit.measurable || std::abs(fit.order - 17) < 0.2) << fit.order;
}

TEST(OrderFit, NamesTheReasonWithoutAnOrder) {
  const auto few = fitOrder({{1, 1e-3}, {0.5, 1e-5}});
  EXPECT_FALSE(few.measurable);
  EXPECT_NE(few.reason.find("2 points"), std::string::npos) << few.reason;

  const auto narrow = fitOrder({{0.1, 1e-3}, {0.08, 7e-4}, {0.07, 5e-4}});
  EXPECT_FALSE(narrow.measurable);
  EXPECT_NE(narrow.reason.find("less than a factor 2"), std::string::npos) << narrow.reason;

  // Slopes that never become constant.
  const auto curved = fitOrder(series(50, [](double h) { return std::exp(-2 / h); }));
  EXPECT_FALSE(curved.measurable) << curved.order;
}

TEST(OrderFit, ErrorsThatStayOrGrowHaveOrdersToo) {
  for (const double p : {-2.0, -1.0, 0.0}) {
    const auto fit = fitOrder(series(200, [p](double h) { return 1e-3 * std::pow(h, p) * (1 + 0.5 * h); }));
    ASSERT_TRUE(fit.measurable) << p << ": " << fit.reason;
    EXPECT_NEAR(fit.order, p, 0.02);
    EXPECT_LT(fit.confidence, 0.02);
  }
}

TEST(OrderFit, SmallErrorsThatGrowAreRoundOff) {
  // Round-off of 1e-16 per step: below 1e-13 there is only noise, with order -1.
  const auto fit = fitOrder(series(3000, [](double h) { return 1e-15 / h; }));
  EXPECT_FALSE(fit.measurable) << fit.order;
}

TEST(OrderFit, NoiseIsNoMeasurement) {
  const auto fit = fitOrder(series(200, [](double h) {
    return h * h * (1 + 0.9 * std::sin(1e4 * h));  // a constant order of magnitude without a slope
  }));
  EXPECT_TRUE(!fit.measurable || std::abs(fit.order - 2) < 0.3) << fit.order;
}

// h^20 (1 + 0.12 h^2) over a factor of two: fitted with 1 + c h, the remaining error of the slope exceeds the limit.
TEST(OrderFit, EvenPowersAreNearerToTheirLimit) {
  std::vector<ErrorPoint> points;
  for (int k = 0; k <= 8; ++k) {
    const double h = std::pow(2.0, -k / 8.0);
    points.push_back({h, 1e-3 * std::pow(h, 20) * (1 + 0.12 * h * h)});
  }
  EXPECT_FALSE(fitOrder(points).measurable);
  OrderFitOptions even;
  even.next_power = 2;
  const auto fit = fitOrder(points, even);
  ASSERT_TRUE(fit.measurable) << fit.reason;
  EXPECT_NEAR(fit.order, 20, 0.2);
}

TEST(OrderFit, OnePercentOfHighOrders) {
  EXPECT_EQ(orderTolerance(-2), 0.2);
  EXPECT_EQ(orderTolerance(19), 0.2);
  EXPECT_NEAR(orderTolerance(40), 0.4, 1e-15);
}

TEST(OrderFit, IgnoresFailedRuns) {
  auto points = series(100, [](double h) { return h * h; });
  points.push_back({0.3, NAN});
  points.push_back({0.2, INFINITY});
  points.push_back({0.1, 0});
  EXPECT_NEAR(fitOrder(points).order, 2, 1e-9);
}

}  // namespace
}  // namespace irk
