// The ratio of two samples of times.
#include "experiments/compare/ratio.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace irk::compare {
namespace {

// Two and two numbers have six orderings, with U = 0, 1, 2, 2, 3, 4.
TEST(Ratio, ProbabilitiesOfRanksAreThoseOfAllOrders) {
  const auto two = rankProbabilities(2, 2);
  const double expected[] = {1 / 6.0, 2 / 6.0, 4 / 6.0, 5 / 6.0, 1};
  ASSERT_EQ(two.size(), 5u);
  for (std::size_t u = 0; u < 5; ++u) EXPECT_NEAR(two[u], expected[u], 1e-15) << u;
  EXPECT_NEAR(rankProbabilities(5, 5)[0], 1 / 252.0, 1e-15);
  EXPECT_NEAR(rankProbabilities(5, 5)[2], 4 / 252.0, 1e-15);  // 1, 1 and 2 orders
}

// The normal approximation continues the exact values without a jump: at both sides of the limit, at the same
// distance from the mean.
TEST(Ratio, ManyNumbersHaveNearlyTheNormalDistribution) {
  const auto exact = rankProbabilities(20, 20), normal = rankProbabilities(20, 21);
  EXPECT_NEAR(exact[200 - 74], normal[210 - 76], 3e-3);
  EXPECT_NEAR(normal[210], 0.5, 6e-3);
}

TEST(Ratio, IsTheMedianWithAllOfTheRangeForFewNumbers) {
  const Ratio one = ratioOf({2}, {6}, 0.05);
  EXPECT_EQ(one.ratio, 3);
  EXPECT_EQ(one.low, 3);
  EXPECT_EQ(one.high, 3);
  EXPECT_EQ(one.level, 0);
  const Ratio two = ratioOf({1, 2}, {3, 8}, 0.05);  // 1.5, 3, 4, 8
  EXPECT_NEAR(two.ratio, std::sqrt(12), 1e-15);
  EXPECT_EQ(two.low, 1.5);
  EXPECT_EQ(two.high, 8);
  EXPECT_NEAR(two.level, 1 - 2 / 6.0, 1e-15);
}

// For samples of five and five P(U <= 2) = 4/252 and P(U <= 3) = 7/252: at 5 % two ratios are left out at each end,
// but not three.
TEST(Ratio, TheIntervalAgreesWithTheRankTest) {
  const std::vector<double> a{1, 1, 1, 1, 1}, b{1, 2, 3, 4, 5};  // each ratio five times
  const Ratio wide = ratioOf(a, b, 0.05);
  EXPECT_NEAR(wide.level, 1 - 8 / 252.0, 1e-12);
  EXPECT_EQ(wide.ratio, 3);
  EXPECT_NEAR(ratioOf(a, b, 0.06).level, 1 - 14 / 252.0, 1e-12);
  EXPECT_NEAR(ratioOf(a, b, 1e-9).level, 1 - 2 / 252.0, 1e-12) << "all of the range";
}

// Samples of one distribution: at most a fraction alpha of the intervals excludes 1, and not many fewer.
TEST(Ratio, TheIntervalHasItsLevel) {
  std::mt19937 random(1);
  std::lognormal_distribution<double> times(0, 0.1);
  constexpr int kTrials = 4000;
  int outside = 0;
  for (int i = 0; i < kTrials; ++i) {
    std::vector<double> a(8), b(8);
    for (auto* sample : {&a, &b}) std::generate(sample->begin(), sample->end(), [&] { return times(random); });
    const Ratio ratio = ratioOf(a, b, 0.05);
    if (ratio.low > 1 || ratio.high < 1) ++outside;
  }
  // P = 0.0499 for eight and eight: 200 of 4000, standard deviation 14.
  EXPECT_LT(outside, 200 + 4 * 14);
  EXPECT_GT(outside, 200 - 4 * 14);
}

}  // namespace
}  // namespace irk::compare
