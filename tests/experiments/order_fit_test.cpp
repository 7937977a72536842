#include "experiments/order_fit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/study.h"
#include "experiments/theory.h"

namespace irk {
namespace {

// error(h) at h = 1/N, N refined by a quarter.
template <class F>
std::vector<ErrorPoint> series(int most, F&& error) {
  std::vector<ErrorPoint> points;
  for (const int n : divisions(1.25, most)) points.push_back({1.0 / n, error(1.0 / n)});
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
  // A level of 1e-12 with some spread: without the window the slope would come out near 3.
  const auto fit = fitOrder(series(
      3000, [](double h) { return std::pow(h, 5) + 1e-12 * (1 + 0.5 * std::sin(1e4 * h)); }));
  ASSERT_TRUE(fit.measurable) << fit.reason;
  EXPECT_NEAR(fit.order, 5, 0.05);
  // Above the noise: h^5 = 1e-11.
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
      {2.0 / 1, 3.331e-12},   {2.0 / 2, 4.210e-17},   {2.0 / 3, 2.445e-20},
      {2.0 / 4, 1.059e-22},   {2.0 / 5, 1.551e-24},   {2.0 / 6, 4.977e-26},
      {2.0 / 7, 2.740e-27},   {2.0 / 8, 2.234e-28},   {2.0 / 9, 2.455e-29},
      {2.0 / 10, 3.411e-30},  {2.0 / 12, 1.123e-31},  {2.0 / 14, 6.256e-33},
      {2.0 / 16, 5.114e-34},  {2.0 / 18, 5.593e-35},  {2.0 / 21, 3.058e-36},
      {2.0 / 24, 2.432e-37},  {2.0 / 28, 1.276e-38},  {2.0 / 32, 9.602e-40},
      {2.0 / 37, 5.421e-41},  {2.0 / 43, 2.429e-42},  {2.0 / 49, 1.242e-43},
      {2.0 / 56, 4.410e-46},  {2.0 / 64, 1.033e-45},  {2.0 / 74, 1.711e-46},
      {2.0 / 85, 2.256e-47},  {2.0 / 98, 2.498e-48},  {2.0 / 113, 2.441e-49},
      {2.0 / 130, 3.106e-50}, {2.0 / 150, 1.331e-50}, {2.0 / 173, 3.550e-50},
      {2.0 / 199, 4.881e-50}, {2.0 / 229, 3.106e-50}};
  OrderFitOptions options;
  options.floor = 5e-49;
  const auto fit = fitOrder(points, options);
  EXPECT_TRUE(!fit.measurable || std::abs(fit.order - 17) < 0.2) << fit.order;
}

TEST(OrderFit, SaysWhyThereIsNone) {
  const auto few = fitOrder({{1, 1e-3}, {0.5, 1e-5}});
  EXPECT_FALSE(few.measurable);
  EXPECT_NE(few.reason.find("2 points"), std::string::npos) << few.reason;

  const auto narrow = fitOrder(series(6, [](double h) { return 1 + h; }));
  EXPECT_FALSE(narrow.measurable);
  EXPECT_NE(narrow.reason.find("less than a factor 10"), std::string::npos) << narrow.reason;

  const auto growing = fitOrder(series(50, [](double h) { return 1e-3 / h; }));
  EXPECT_FALSE(growing.measurable);

  // Slopes that never settle.
  const auto curved = fitOrder(series(50, [](double h) { return std::exp(-2 / h); }));
  EXPECT_FALSE(curved.measurable) << curved.order;
}

TEST(OrderFit, IgnoresFailedRuns) {
  auto points = series(100, [](double h) { return h * h; });
  points.push_back({0.3, NAN});
  points.push_back({0.2, INFINITY});
  points.push_back({0.1, 0});
  EXPECT_NEAR(fitOrder(points).order, 2, 1e-9);
}

TEST(Theory, Ode) {
  const auto order = [](const char* family, Index s) {
    return theoreticalOrder(family, s, SystemKind::kOde, 'x');
  };
  EXPECT_EQ(order("gauss", 20), 40);
  EXPECT_EQ(order("radau_ia", 3), 5);
  EXPECT_EQ(order("radau_iia", 20), 39);
  for (const char* family :
       {"lobatto_iiia", "lobatto_iiib", "lobatto_iiic", "lobatto_iiics", "lobatto_iiid"}) {
    EXPECT_EQ(order(family, 4), 6) << family;
  }
  EXPECT_FALSE(order("my_method", 3));
}

struct Expected {
  const char* family;
  SystemKind kind;
  char component;
  std::vector<double> orders;  // from the family's smallest s on
};

TEST(Theory, MechanicalSystemsAsPublished) {
  const Expected table[] = {{"gauss", SystemKind::kIndex2, 'u', {2, 4, 6, 8, 10}},
                            {"gauss", SystemKind::kIndex2, 'v', {2, 2, 4, 4, 6}},
                            {"gauss", SystemKind::kIndex2, 'z', {0, 0, 2, 2, 4}},
                            {"gauss", SystemKind::kIndex3, 'u', {2, 2, 4, 4, 6}},
                            {"gauss", SystemKind::kIndex3, 'v', {0, 0, 2, 2, 4}},
                            {"gauss", SystemKind::kIndex3, 'z', {-2, -2, 0, 0, 2}},
                            {"radau_ia", SystemKind::kIndex2, 'u', {1, 3, 5, 7, 9}},
                            {"radau_ia", SystemKind::kIndex2, 'v', {1, 2, 3, 4, 5}},
                            {"radau_ia", SystemKind::kIndex2, 'z', {1, 1, 2, 3, 4}},
                            {"radau_ia", SystemKind::kIndex3, 'u', {1, 2, 3, 4, 5}},
                            {"radau_ia", SystemKind::kIndex3, 'v', {1, 1, 2, 3, 4}},
                            {"radau_ia", SystemKind::kIndex3, 'z', {1, 0, 1, 2, 3}},
                            {"radau_iia", SystemKind::kIndex2, 'u', {1, 3, 5, 7, 9}},
                            {"radau_iia", SystemKind::kIndex2, 'v', {1, 3, 5, 7, 9}},
                            {"radau_iia", SystemKind::kIndex2, 'z', {1, 2, 3, 4, 5}},
                            {"radau_iia", SystemKind::kIndex3, 'u', {1, 3, 5, 7, 9}},
                            {"radau_iia", SystemKind::kIndex3, 'v', {1, 2, 3, 4, 5}},
                            {"radau_iia", SystemKind::kIndex3, 'z', {1, 1, 2, 3, 4}},
                            {"lobatto_iiia", SystemKind::kIndex2, 'v', {2, 4, 6, 8}},
                            {"lobatto_iiia", SystemKind::kIndex2, 'z', {2, 2, 4, 4}},
                            {"lobatto_iiia", SystemKind::kIndex3, 'u', {2, 2, 6, 6}},
                            {"lobatto_iiia", SystemKind::kIndex3, 'v', {2, 2, 4, 4}},
                            {"lobatto_iiia", SystemKind::kIndex3, 'z', {0, 0, 2, 2}},
                            {"lobatto_iiic", SystemKind::kIndex2, 'u', {2, 4, 6, 8}},
                            {"lobatto_iiic", SystemKind::kIndex2, 'z', {1, 2, 3, 4}},
                            {"lobatto_iiic", SystemKind::kIndex3, 'v', {1, 2, 3, 4}},
                            {"lobatto_iiic", SystemKind::kIndex3, 'z', {0, 1, 2, 3}}};
  for (const auto& [family, kind, component, orders] : table) {
    Index s = std::string_view(family).starts_with("lobatto") ? 2 : 1;
    for (const double order : orders) {
      EXPECT_EQ(theoreticalOrder(family, s, kind, component), order)
          << family << " s = " << s << " " << component;
      ++s;
    }
  }
  EXPECT_FALSE(theoreticalOrder("lobatto_iiib", 3, SystemKind::kIndex2, 'u'));
}

}  // namespace
}  // namespace irk
