// A result that is negative where an exact solution never is: concentrations and amounts.
#include <gtest/gtest.h>

#include <string>

#include "tests/core/trusted.h"

namespace irk::test {
namespace {

/// x_0' = -1, x_1' = -1, and x_1 is said to be never negative. From (1, 1) it is false after t = 1.
struct Emptying {
  Sizes sizes() const { return {.nx = 2}; }
  bool nonNegative(Index i) const { return i == 1; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = -1 - p.k[0];
    r.x[1] = -1 - p.k[1];
  }
};

constexpr double kTol = 1e-4, kAllowed = 200 * kTol;  // tolerances, with |x| < 1 and a scale of 1

Solution<double> emptied(double t_end, const IntegratorOptions& options, Formulation form = Formulation::kIndex2) {
  State<double> start(Sizes{.nx = 2});
  start.x << 1, 1;
  return integrate<double>(Emptying{}, start, t_end, makeTableau<double>("radau_iia_3"), options, form);
}

TEST(Bounds, ANegativeResultIsInaccurateWhereItCannotBe) {
  for (const IntegratorOptions& options : {adaptive(kTol), embedded(kTol)}) {
    for (const Formulation form : {Formulation::kIndex2, Formulation::kFirstOrder}) {
      const Solution<double> below = emptied(1 + 1.2 * kAllowed, options, form);
      EXPECT_EQ(below.outcome, Outcome::kInaccurate);
      EXPECT_NE(below.detail.find("x[1] = -0.024"), std::string::npos) << below.detail;
      EXPECT_NE(below.detail.find("never negative"), std::string::npos) << below.detail;
      const Solution<double> within = emptied(1 + 0.9 * kAllowed, options, form);
      EXPECT_EQ(within.outcome, Outcome::kSuccess) << within.detail;
    }
  }
}

// The paper's successes are reported as they are.
TEST(Bounds, ThePapersEstimateDoesNotLookAtThem) {
  IntegratorOptions options = adaptive(kTol);
  options.step.estimate = ErrorEstimate::kDoubling;
  EXPECT_EQ(emptied(2, options).outcome, Outcome::kSuccess);
}

}  // namespace
}  // namespace irk::test
