// The elastic arm that strikes a stop: forces, energy, equilibrium.
#include <gtest/gtest.h>

#include <vector>

#include "tests/problems/equilibrium.h"
#include "tests/problems/scene_run.h"

namespace irk::test {
namespace {

constexpr double kWeight = 1200 * 0.0018 * 9.81;  // N, of the arm of 1 m

struct Course {
  std::vector<double> energy, force;
  std::vector<std::string> switches;
  Outcome outcome = Outcome::kSuccess;
};

Course courseOf(const Settings& settings) {
  const auto scene = makeScene<double>("ancf_stop", settings);
  Course course;
  Monitor<double> monitor;
  monitor.accepted = [&](const StepRecord<double>& step) {
    course.energy.push_back(valueOf(scene, "energy", step.state));
    course.force.push_back(valueOf(scene, "N", step.state));
  };
  monitor.switched = [&](const SwitchRecord<double>& s) { course.switches.push_back(s.name); };
  IntegratorOptions options;
  options.tolerances.rtol = options.tolerances.atol = 1e-9;
  Integrator<double> integrator(scene.system({}), makeTableau<double>("radau_iia_5"), options, scene.scale);
  course.outcome = integrator.integrate(scene.start, scene.t_end, monitor).outcome;
  return course;
}

TEST(AncfStop, KeepsItsEnergyWithoutFrictionAndDamping) {
  const Course course = courseOf({{"mu", "0"}, {"c", "0"}});
  ASSERT_EQ(course.outcome, Outcome::kSuccess);
  EXPECT_GE(course.switches.size(), 2U);  // it bounces
  for (const double energy : course.energy) EXPECT_NEAR(energy, 0, 1e-6 * kWeight);
}

TEST(AncfStop, LosesEnergyToFrictionAndDamping) {
  for (const Settings& settings : {Settings{{"mu", "0"}}, Settings{{"c", "0"}}}) {
    const Course course = courseOf(settings);
    ASSERT_EQ(course.outcome, Outcome::kSuccess);
    double last = 0;
    for (const double energy : course.energy) {
      EXPECT_LT(energy, last + 1e-6 * kWeight);
      last = energy;
    }
    EXPECT_LT(last, -1e-3 * kWeight);
  }
}

TEST(AncfStop, PushesAndNeverPulls) {
  const Course course = courseOf({});
  ASSERT_EQ(course.outcome, Outcome::kSuccess);
  double most = 0;
  for (const double force : course.force) {
    EXPECT_GE(force, -1e-6 * kWeight);
    most = std::max(most, force);
  }
  EXPECT_GT(most, 10 * kWeight);
}

// In contact and at rest the stop carries what turns the arm about its hinge: N x_tip is the moment of the weight.
TEST(AncfStop, RestsOnTheStopInEquilibrium) {
  const auto scene = makeScene<double>("ancf_stop");
  const auto system = scene.system({});
  State<double> guess = scene.start;
  guess.d << 1, 0, 1;
  const double slope = -0.3;  // the straight arm with its tip on the stop
  const double run = std::sqrt(1 - slope * slope);
  guess.u << run, slope, run / 2, slope / 2, run, slope, run, slope, run, slope;
  const auto rest = equilibriumOf(*system, guess);
  ASSERT_TRUE(rest);
  const auto& u = rest->u;  // s0, r1, s1, tip, s2
  const double le = 0.5;
  const double area =
      le / 2 * u[2] + le * le / 12 * (u[0] - u[4]) + le / 2 * (u[2] + u[6]) + le * le / 12 * (u[4] - u[8]);
  const double force = valueOf(scene, "N", *rest);
  EXPECT_NEAR(force * u[6], kWeight * area, 1e-9 * kWeight);
  EXPECT_NEAR(force, 1e5 * (-0.3 - u[7]), 1e-9 * kWeight);
  EXPECT_GT(force, kWeight / 3);
  EXPECT_LT(force, kWeight);
}

// The modes of friction: sliding has its full size, creeping falls with the speed, and both agree where they meet.
TEST(AncfStop, FrictionOpposesTheTip) {
  const auto scene = makeScene<double>("ancf_stop");
  const auto system = scene.system({Formulation::kIndex3});
  const Sizes n = system->sizes();
  State<double> s = scene.start;
  s.u[7] = -0.301;  // 1 mm deep: N = 100
  const auto forceAt = [&](double v, const std::vector<double>& d) {
    s.v[6] = v;
    s.d = Eigen::Map<const Vec<double>>(d.data(), 3);
    const auto with = residualAt<double, double>(*system, Level::kFormulated, 0, pointVector(s), s.d);
    s.d.setZero();
    const auto without = residualAt<double, double>(*system, Level::kFormulated, 0, pointVector(s), s.d);
    return with[6] - without[6];
  };
  ASSERT_EQ(n.nu, 10);
  EXPECT_NEAR(forceAt(1, {1, 1, 0}), -30, 1e-9);
  EXPECT_NEAR(forceAt(-1, {1, -1, 0}), 30, 1e-9);
  EXPECT_NEAR(forceAt(0.005, {1, 0, 1}), -15, 1e-9);
  EXPECT_NEAR(forceAt(0.01, {1, 0, 1}), -30, 1e-9);
  EXPECT_EQ(forceAt(1, {0, 0, 1}), 0);
}

}  // namespace
}  // namespace irk::test
