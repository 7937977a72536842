// The errors of many steps add up; if their sum may spoil the result, the run is not a success.
#include <gtest/gtest.h>

#include <cmath>

#include "core/estimates/accumulation.h"
#include "tests/core/support.h"

namespace irk::test {
namespace {

/// u'' = -u - (u - cos t) (u + v), u(0) = 1, v(0) = 0: u = cos t.
struct Oscillator {
  Sizes sizes() const { return {.nu = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    const T& u = p.u[0];
    r.u[0] = -u - 0.01 * (u - cos(p.t)) * (u + p.v[0]) - p.a[0];
  }
};

Solution<double> oscillate(const char* method, double tol, double t_end) {
  State<double> start(Oscillator{}.sizes());
  start.u[0] = 1;
  return integrate<double>(Oscillator{}, start, t_end, makeTableau<double>(method), adaptive(tol));
}

TEST(ErrorSum, IsAboveItsBarAfterTwoHundredTolerances) {
  ErrorSum sum({1e-4, 1e-4, NormKind::kMixed});
  sum.begin();
  for (int i = 0; i < 200; ++i) sum.add(0.999);
  EXPECT_FALSE(sum.aboveBar());
  sum.add(1.1);
  EXPECT_TRUE(sum.aboveBar());
  sum.begin();
  EXPECT_FALSE(sum.aboveBar());
}

// A sum of 2e-10 is accepted at any tolerance.
TEST(ErrorSum, AllowsRoundOffAtTightTolerances) {
  ErrorSum sum({1e-13, 1e-13, NormKind::kMixed});
  sum.begin();
  sum.add(2'190);
  EXPECT_FALSE(sum.aboveBar());
  sum.add(20);
  EXPECT_TRUE(sum.aboveBar());
}

// If N steps have estimates that reach the tolerance after multiplication by the factor, their errors add up to about
// a hundred tolerances, for every N. 4: the least caution of estimates by doubling.
TEST(ErrorSum, OfStepsUnderAccumulationStaysBelowTheBar) {
  const Tolerances tolerances{1e-8, 1e-8, NormKind::kMixed};
  const Accumulation accumulation(4, tolerances);
  double sum = 0;
  for (int i = 0; i < 15'000; ++i) sum += 1 / accumulation.factor(i, sum);
  EXPECT_GT(sum, 40);
  EXPECT_LT(sum, 150);
}

// Errors far below the tolerance are not reduced further, however many there are.
TEST(ErrorSum, AsksNothingOfSmallErrors) {
  const Accumulation accumulation(10, {1e-8, 1e-8, NormKind::kMixed});
  EXPECT_EQ(accumulation.factor(100'000, 3), 10);
  EXPECT_GT(accumulation.factor(100'000, 30), 10);
  EXPECT_LE(accumulation.factor(100'000, 300), 300);
}

// A rejected error is accepted if a shorter step does not reduce it, and not if it does.
TEST(ErrorSum, IsNotControlledByStepsThatDoNotHelp) {
  Accumulation accumulation(1, {1e-8, 1e-8, NormKind::kMixed});
  EXPECT_EQ(accumulation.asked(0.5, 10, 1, 0.1), 5);
  EXPECT_EQ(accumulation.asked(0.49, 10, 1, 0.05), 1) << "accepted";
  EXPECT_EQ(accumulation.asked(0.5, 10, 2, 0.1), 5);
  EXPECT_EQ(accumulation.asked(0.3, 10, 2, 0.05), 3) << "it falls";
  EXPECT_EQ(accumulation.asked(2, 10, 3, 0.1), 20);
  EXPECT_EQ(accumulation.asked(2, 10, 3, 0.05), 20) << "above the tolerance";
  EXPECT_EQ(accumulation.asked(2, 10, 3.05, 0.05), 20) << "another step";
}

TEST(ErrorSum, ManyStepsOfLowOrderAreRightOrSaySo) {
  int right = 0, failed = 0;
  for (const double t_end : {3.0, 30.0, 300.0, 1000.0}) {
    for (const double tol : {1e-4, 1e-6}) {
      const auto s = oscillate("radau_iia_1", tol, t_end);
      if (s.outcome == Outcome::kSuccess) {
        ++right;
        EXPECT_LE(std::abs(s.state.u[0] - std::cos(t_end)), 1000 * tol) << t_end << " " << tol;
      } else {
        ++failed;
        EXPECT_EQ(s.outcome, Outcome::kInaccurate) << s.detail;
        EXPECT_NE(s.detail.find("sum of the estimated errors"), std::string::npos) << s.detail;
      }
    }
  }
  EXPECT_GE(right, 2);
  EXPECT_GE(failed, 1);
}

TEST(ErrorSum, HighOrderIsNotBlamedForItsEstimate) {
  for (const char* method : {"radau_iia_3", "gauss_3"}) {
    const auto s = oscillate(method, 1e-9, 300);
    ASSERT_EQ(s.outcome, Outcome::kSuccess) << method << s.detail;
    EXPECT_NEAR(s.state.u[0], std::cos(300.0), 1e-6) << method;
  }
}

}  // namespace
}  // namespace irk::test
