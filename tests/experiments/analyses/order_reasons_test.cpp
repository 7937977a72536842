// What orders.csv says of an order above theory: a second window of steps must show it, too.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "experiments/analyses/orders/order_fit.h"
#include "experiments/base/numbers.h"
#include "tests/experiments/analyses/analysis_tables.h"

namespace irk {
namespace {

// The reason of z's order on index2_nonlinear with radau_iia_3, for which theory gives 3. The steps are 1 / n.
std::string reasonOf(const std::vector<double>& all_n, const std::function<double(double)>& error) {
  Table runs;
  runs.columns = {"scene",   "settings", "method",  "family", "stages",  "formulation", "multipliers", "scalar",
                  "control", "h",        "outcome", "error",  "error_u", "error_v",     "error_x",     "error_z"};
  for (const double n : all_n) {
    const std::string z = numberText(error(1 / n));
    runs.rows.push_back({"index2_nonlinear", "", "radau_iia_3", "radau_iia", "3", "index2", "stages", "double", "fixed",
                         numberText(1 / n), "success", z, "nan", "nan", "nan", z});
  }
  const Table orders = orderTable(runs);
  EXPECT_EQ(orders.rows.size(), 1u);
  if (orders.rows.empty()) return {};
  EXPECT_EQ(textAt(orders, orders.rows[0], "verdict"), "differs") << textAt(orders, orders.rows[0], "order");
  return textAt(orders, orders.rows[0], "reason");
}

TEST(OrderReasons, OneWindowAloneExcitesNoSentence) {
  const std::string one = reasonOf({8, 12, 16, 24}, [](double h) { return std::pow(h, 5); });
  EXPECT_NE(one.find("no second window of steps shows it"), std::string::npos) << one;
}

TEST(OrderReasons, TwoWindowsThatDifferAreNamed) {
  // Order 4 down to h = 1/32, and 5 from there on.
  const std::string two = reasonOf({8, 10, 12, 16, 20, 24, 32, 48, 64},
                                   [](double h) { return h > 0.03 ? std::pow(h, 4) : 32 * std::pow(h, 5); });
  EXPECT_NE(two.find("the steps 1.2e-01 to "), std::string::npos) << two;
  EXPECT_NE(two.find(" have 4"), std::string::npos) << two;
}

TEST(OrderReasons, TwoWindowsThatAgreeDo) {
  // A wave on the steps between parts the line in two windows of one slope.
  const std::string two = reasonOf({2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64},
                                   [](double h) { return 1e-3 * std::pow(h, 5) * (h < 0.15 && h > 0.05 ? 1.5 : 1.0); });
  EXPECT_NE(two.find("also at the steps"), std::string::npos) << two;
  EXPECT_NE(two.find("does not excite its worst term"), std::string::npos) << two;
}

TEST(OrderFit, SecondWindowIsBesideTheFirst) {
  std::vector<ErrorPoint> points;
  for (int i = 0; i < 16; ++i) {
    const double h = std::pow(0.8, i);
    points.push_back({h, h > 0.3 ? std::pow(h, 4) : 0.3 * std::pow(h, 3)});  // order 4, then 3
  }
  OrderFit first;
  first.measurable = true;
  first.order = 4;
  first.h_max = 1;
  first.h_min = std::pow(0.8, 5);
  const OrderFit second = secondWindow(points, first, {});
  ASSERT_TRUE(second.measurable) << second.reason;
  EXPECT_NEAR(second.order, 3, 1e-9);
  EXPECT_LE(second.h_max, first.h_min);
  first.h_min = points.back().h;
  EXPECT_FALSE(secondWindow(points, first, {}).measurable) << "nothing is left";
}

}  // namespace
}  // namespace irk
