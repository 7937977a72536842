// One tiny contraction after a huge increment proves nothing.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/one_step.h"

namespace irk::test {
namespace {

// F(z) = (d + sqrt(d^2 + s^2)) / 2 + e (z - r(t)), d = z - c(t): the slope is 1 above the corner c, where the start
// values are, and e below it, where the root of the next stage is. The first increment leads to the corner, the second
// one is 25 tolerances, and the root is 25 000 tolerances away.
struct Corner {
  static constexpr double kTolerance = 1e-5, kShare = 1e-3, kSharpness = 1e-5;
  static constexpr double kMove = 3;      // of the corner, to t = 1
  static constexpr double kBelow = 0.25;  // the root below the corner at t = 1
  static constexpr double kAbove = 1;     // the root above the corner at t = 0, z = 0

  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 1, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sqrt;
    const T c = -kAbove + (kAbove - kMove) * p.t;
    const T root = (1 - p.t) * (kAbove / kShare) - (kMove + kBelow) * p.t;
    const T d = p.z[0] - c;
    r.x[0] = p.k[0];
    r.z[0] = 0.5 * (d + sqrt(d * d + kSharpness * kSharpness)) + kShare * (p.z[0] - root);
  }
};

// One step of the implicit Euler method. The root's z is -3.25.
TEST(TrustedIncrement, ATinyContractionAfterAHugeIncrementDoesNotCount) {
  OneStep step(Corner{}, "radau_iia_1", adaptive(Corner::kTolerance), {0, Corner::kTolerance, NormKind::kAbsolute});
  EXPECT_EQ(step.solve(State<double>(Corner{}.sizes()), 1), Outcome::kNewtonFailed) << step.to.z()[0];
}

}  // namespace
}  // namespace irk::test
