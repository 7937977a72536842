// The embedded estimate is filtered twice in the first step and after rejections, HW II (IV.8.20).
#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/support.h"

namespace irk::test {
namespace {

/// x' = -1e6 (x - cos t): a deviation of the start from cos t decays at once.
struct Relaxing {
  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    r.x[0] = -1e6 * (p.x[0] - cos(p.t)) - p.k[0];
  }
};

// In a step over the transient, the estimate filtered once is about the deviation of the start, 20 tolerances,
// although the error of the step is much smaller.
TEST(EmbeddedEstimate, OfAFirstStepOverATransientRejectsNothing) {
  for (const char* method : {"radau_iia_3", "radau_iia_5"}) {
    IntegratorOptions o = embedded(1e-4);
    o.step.h = 0.1;
    State<double> start(Relaxing{}.sizes());
    start.x[0] = 1 + 4e-3;
    const auto s = integrate<double>(Relaxing{}, start, 0.1, makeTableau<double>(method), o);
    ASSERT_EQ(s.outcome, Outcome::kSuccess) << s.detail;
    EXPECT_EQ(s.counters.steps_accepted, 1) << method;
    EXPECT_EQ(s.counters.steps_rejected_error, 0) << method;
    EXPECT_NEAR(s.state.x[0], std::cos(0.1), 1e-5) << method;
  }
}

}  // namespace
}  // namespace irk::test
