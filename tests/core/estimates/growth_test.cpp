// The growth of errors at a point of a motion.
#include "core/integration/growth.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/resting_systems.h"
#include "tests/core/support.h"

namespace irk::test {
namespace {

double growth(const std::shared_ptr<const System<double>>& system, const State<double>& state, double time) {
  return Growth<double>(*system, {}, {}).rate(state, time);
}

TEST(Growth, IsTheLargestEigenvalueThatGrowsInTime) {
  const auto spiral = [](double rate) { return makeSystem<double>(Spiral{rate, 100}); };
  State<double> rest(Spiral{}.sizes());
  rest.x.setOnes();
  const double size = std::hypot(2, 100);
  EXPECT_NEAR(growth(spiral(2), rest, 1), size, 1e-10 * size);
  EXPECT_EQ(growth(spiral(2), rest, 0.49), 0) << "less than a factor e";
  EXPECT_EQ(growth(spiral(0), rest, 1e6), 0) << "an oscillation";
  EXPECT_EQ(growth(spiral(-2), rest, 1e6), 0);
}

TEST(Growth, RestsInAModeWhateverTheOthersDo) {
  const auto system = makeSystem<double>(RestBesideMotion{100});
  const auto rate = [&](double deviation) {
    State<double> s(system->sizes());
    s.v[0] = 1;
    s.x[0] = 1 + deviation;
    s.w << 0, 100 * std::sin(deviation);
    Growth<double> growth(*system, {.atol = 1e-4, .norm = NormKind::kAbsolute}, {});
    growth.speed(s);
    EXPECT_GT(growth.rate(s, 10), 0);
    const auto motions = growth.motions(s, 10, 0);
    EXPECT_NEAR(motions->faster, motions->resting, 1e-9) << "not an oscillation";
    EXPECT_NEAR(motions->living, 100, 1e-4);
    EXPECT_FALSE(motions->vanished);
    return motions->resting;
  };
  EXPECT_NEAR(rate(1e-9), 100, 1e-4);
  EXPECT_NEAR(rate(0.9e-4), 100, 1e-4);
  EXPECT_EQ(rate(1.1e-4), 0) << "it is further away than the tolerance";
}

// With its multiplier a pendulum in Cartesian coordinates has the growth of one in the angle: sqrt(g / l).
TEST(Growth, OfAConstrainedMotionIsThatAlongTheConstraint) {
  const LongPendulum<double> problem{2};
  State<double> upright(problem.sizes()), hanging(problem.sizes());
  upright.u << 0, 2;
  upright.w[2] = -9.81 / 2;
  hanging.u << 0, -2;
  hanging.w[2] = 9.81 / 2;
  const auto system = makeSystem<double>(problem);
  EXPECT_NEAR(growth(system, upright, 10), std::sqrt(9.81 / 2), 1e-8);
  EXPECT_EQ(growth(system, hanging, 10), 0);
}

}  // namespace
}  // namespace irk::test
