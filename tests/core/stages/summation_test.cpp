// Compensated summation of the increments.
#include <gtest/gtest.h>

#include <limits>

#include "tests/core/support.h"

namespace irk::test {
namespace {

/// x' = 0.1, u'' = 0: every step adds the same small number to a large one.
struct Ramp {
  Sizes sizes() const { return {.nu = 1, .nx = 1, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -p.a[0];
    r.x[0] = 0.1 - p.k[0];
  }
};

State<double> afterManySteps(Summation summation) {
  const auto start = startOf(Ramp{}, {.u = {1000}, .v = {0.1}, .x = {1000}});
  auto options = fixedSteps(1e-3);
  options.summation = summation;
  const auto s = integrate<double>(Ramp{}, start, 100, makeTableau<double>("gauss_2"), options);
  EXPECT_EQ(s.outcome, Outcome::kSuccess);
  EXPECT_EQ(s.counters.steps_accepted, 100'000);
  return s.state;
}

TEST(Summation, CompensatedKeepsTheRoundOffOfAdditions) {
  // 1000 + 0.1 * 100, with 0.1 as a double, to half an ulp of 1010.
  const double exact = 1010, ulp = 1010 * std::numeric_limits<double>::epsilon();
  const auto compensated = afterManySteps(Summation::kCompensated);
  const auto plain = afterManySteps(Summation::kPlain);
  EXPECT_NEAR(compensated.x[0], exact, ulp);
  EXPECT_NEAR(compensated.u[0], exact, ulp);
  EXPECT_GT(std::abs(plain.x[0] - exact), 100 * ulp);
  EXPECT_GT(std::abs(plain.u[0] - exact), 100 * ulp);
  // The carry is the round-off that the state lacks.
  EXPECT_LT(std::abs(compensated.carry[2]), ulp);
  EXPECT_EQ(plain.carry.cwiseAbs().maxCoeff(), 0);
}

}  // namespace
}  // namespace irk::test
