#include "core/control/order_controller.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace irk::test {
namespace {

constexpr std::array<OrderMember, 3> kMembers{{{3, 3, 1}, {5, 5, 1}, {7, 7, 1}}};

std::unique_ptr<OrderController> variable() {
  return makeOrderController(OrderControl::kVariable, {kMembers, 3, [](std::size_t) { return 1.0; }});
}

// The decision after the seventh of equal steps of member 1; each of them leads to the step 0.9 `h`.
OrderDecision seventh(double error, double lower) {
  const auto controller = variable();
  const OrderFacts facts{1, error, std::numeric_limits<double>::quiet_NaN(), 0.01, 4, 0.1, 0.09};
  for (int step = 1; step < 7; ++step) {
    EXPECT_FALSE(controller->needsLower()) << step;
    const auto same = controller->decide(facts);
    EXPECT_EQ(same.next, 1U) << step;
    EXPECT_EQ(same.h, facts.h_next);
    EXPECT_EQ(same.error, error);
  }
  EXPECT_TRUE(controller->needsLower());
  OrderFacts last = facts;
  last.lower = lower;
  return controller->decide(last);
}

TEST(OrderController, OnlyVariableOrderHasOne) {
  EXPECT_TRUE(choosesOrder(OrderControl::kVariable));
  EXPECT_FALSE(choosesOrder(OrderControl::kFixed));
  EXPECT_EQ(makeOrderController(OrderControl::kFixed, {kMembers, 3, {}}), nullptr);
}

// Neighbouring members have errors in the ratio 1e-3: two more stages allow a step that is more than twice as long.
TEST(OrderController, GoesUpWhereErrorsFallFast) {
  const auto decision = seventh(1, 1e3);
  EXPECT_EQ(decision.next, 2U);
  EXPECT_GT(decision.h, 2 * 0.09);
  EXPECT_LT(decision.error, 0.01);
}

// The error of the member below is as small, and each of its steps costs less.
TEST(OrderController, GoesDownWhereTheMemberBelowIsAsAccurate) {
  const auto decision = seventh(0.9, 0.9);
  EXPECT_EQ(decision.next, 0U);
  EXPECT_EQ(decision.error, 0.9);
}

TEST(OrderController, LeavesTheMemberAfterRepeatedFailuresOfNewton) {
  const auto controller = variable();
  EXPECT_EQ(controller->afterFailure(1, 1, true), 1U);
  EXPECT_EQ(controller->afterFailure(1, 2, true), 0U);
  EXPECT_EQ(controller->afterFailure(0, 9, true), 0U);
  // The size of the first step is a guess, which failures shorten.
  EXPECT_EQ(controller->afterFailure(1, 12, false), 1U);
}

}  // namespace
}  // namespace irk::test
