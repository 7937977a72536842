// The closed forms of the foreign scenes where the equations alone do not check them: across switches and impacts,
// through a singular position, and beyond the end of a solution.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/problems/scene_cases.h"

namespace irk::test {
namespace {

bool hasSolution(const Scene<double>& scene, double t) {
  const auto s = scene.exact(t);
  const bool finite = s.u.allFinite() && s.v.allFinite() && s.x.allFinite();
  // Unknown would be NaN, and judged by other references.
  EXPECT_TRUE(finite || std::isinf(s.u.size() > 0 ? s.u[0] : s.x[0])) << scene.id;
  return finite;
}

// The ends: y0^2 / 2; 1 / y0; 0.7 m / v0; fall (1 + e) / (1 - e) with fall = sqrt(2 h0 / g).
TEST(Foreign, SolutionsEndWhereTheyShould) {
  struct Case {
    const char* scene;
    Settings settings;
    double end;
  };
  for (const auto& [id, settings, end] : {Case{"solution_end", {{"y0", "0.5"}}, 0.125},
                                          {"blow_up", {{"y0", "2"}}, 0.5},
                                          {"bead_cross", {{"v0", "2"}}, 0.35},
                                          {"bouncing_ball", {{"e", "0.5"}, {"h0", "4.905"}}, 3}}) {
    const auto scene = makeScene<double>(id, settings);
    EXPECT_TRUE(hasSolution(scene, 0.999 * end)) << id;
    EXPECT_FALSE(hasSolution(scene, 1.001 * end)) << id;
  }
}

// h0 = 4.905 m: it falls for 1 s; the flights of e = 0.5 last 1 s, 0.5 s, ... and are 1.22625 m, ... high.
TEST(Foreign, TheBallLosesItsPartOfTheSpeed) {
  const auto scene = makeScene<double>("bouncing_ball", {{"e", "0.5"}, {"h0", "4.905"}});
  EXPECT_NEAR(scene.exact(0.5).u[0], 4.905 * 0.75, 1e-14);
  EXPECT_NEAR(scene.exact(1.5).u[0], 4.905 / 4, 1e-14);
  EXPECT_NEAR(scene.exact(1.5).v[0], 0, 1e-14);
  EXPECT_NEAR(scene.exact(2.25).u[0], 4.905 / 16, 1e-14);
  EXPECT_EQ(scene.exact(2.25).d[0], 2);
  EXPECT_NEAR(scene.exact(2.000001).v[0], 4.905 / 2, 1e-4);
}

// The value at t = 5 is from another integration, along the wire's parameter.
TEST(Foreign, TheBeadPassesTheCrossingStraight) {
  const auto scene = makeScene<double>("bead_eight");
  const auto end = scene.exact(5);
  EXPECT_NEAR(end.u[0], 0.30940542, 1e-8);
  EXPECT_NEAR(end.u[1], -0.29422296, 1e-8);
  for (const double t : {0.3, 1.5, 1.6, 4.0}) {
    const auto s = scene.exact(t);
    EXPECT_NEAR(s.v.norm(), 1, 1e-14) << t;
    EXPECT_NEAR(std::pow(s.u[0], 4) - s.u[0] * s.u[0] + s.u[1] * s.u[1], 0, 1e-15) << t;
  }
  const auto before = scene.exact(1.52), after = scene.exact(1.53);
  EXPECT_GT(before.u[0], 0);
  EXPECT_LT(after.u[0], 0);
  EXPECT_NEAR(before.v[0], -std::sqrt(0.5), 1e-3);
  EXPECT_NEAR(after.v[1], -std::sqrt(0.5), 1e-3);
}

// The supply changes only at the ends of the hysteresis, and `on` is the time for which it was on.
TEST(Foreign, TheControlSwitchesAtTheEndsOfItsHysteresis) {
  const auto scene = makeScene<double>("two_point_control", {{"middle", "10"}, {"width", "0.5"}});
  constexpr double kStep = 1e-3;
  auto last = scene.exact(0);
  int switches = 0;
  for (int i = 1; i <= 10000; ++i) {
    const auto s = scene.exact(i * kStep);
    EXPECT_LE(std::abs(s.x[0] - 10), 0.25 + 1e-14);
    EXPECT_LE(std::abs(s.x[0] - last.x[0]), kStep * 0.5 * 1.15 + 1e-14);  // the rate is at most width (1 + 0.3 / 2)
    const double on = s.x[1] - last.x[1];
    if (s.d[0] == last.d[0]) {
      EXPECT_NEAR(on, kStep * s.d[0], 1e-13);
    } else {
      ++switches;
      EXPECT_NEAR(s.x[0], last.d[0] > 0 ? 10.25 : 9.75, kStep);
    }
    last = s;
  }
  EXPECT_GE(switches, 8);
}

// A pulse of the input moves the solution by 20 times its area in a narrow limit.
TEST(Foreign, APulseLeavesItsArea) {
  const auto with = makeScene<double>("input_pulse", {{"width", "0.001"}}).exact(2);
  EXPECT_NEAR(with.x[0] - std::exp(-2), 20 * 0.001 * std::exp(-1), 2e-5);
  const auto kink = makeScene<double>("input_kink", {{"slope", "2"}, {"at", "0.5"}, {"y0", "1"}});
  EXPECT_EQ(kink.exact(0.4).x[0], std::exp(-0.4));
  EXPECT_NEAR(kink.exact(0.6).x[0] - std::exp(-0.6), 0.1 * 0.1, 4e-4);  // slope since^2 / 2
}

}  // namespace
}  // namespace irk::test
