// When motions that rest are looked at, and what is seen then.
#include <gtest/gtest.h>

#include <cmath>

#include "core/integration/unstable_rest.h"
#include "tests/core/error_bar_run.h"

namespace irk::test {
namespace {

constexpr double kAtRest = 0.01, kMoves = 1e6;

/// The steps of size h until the next look, which is counted, at a motion of this speed.
int stepsToLook(LookTimes& times, double h, double speed, Index components) {
  for (int steps = 1;; ++steps) {
    times.step(h, speed);
    if (!times.due(h, components)) continue;
    times.lookedAtAll();
    return steps;
  }
}

TEST(LookTimes, AreOnceInSoManyStepsAsThereAreComponents) {
  LookTimes times(1000);
  times.begin();
  EXPECT_EQ(stepsToLook(times, 0.01, kMoves, 30), 1) << "the start may be a rest";
  EXPECT_EQ(stepsToLook(times, 0.01, kMoves, 3), 30);
  EXPECT_EQ(stepsToLook(times, 0.01, kMoves, 3), 10) << "at least ten";
  stepsToLook(times, 0.01, kAtRest, 3);
  EXPECT_EQ(stepsToLook(times, 0.01, kAtRest, 3), 3) << "not at rest";
}

TEST(LookTimes, AMotionThatComesToRestIsLookedAt) {
  LookTimes times(1000);
  times.begin();
  stepsToLook(times, 0.01, kMoves, 30);
  stepsToLook(times, 0.01, kMoves, 30);
  times.step(0.01, kAtRest);
  EXPECT_FALSE(times.due(0.01, 30)) << "it moved at the start of this step";
  times.step(0.01, kAtRest);
  EXPECT_TRUE(times.due(0.01, 30));
}

TEST(LookTimes, NoTwentiethOfTheIntervalAtRestIsPassedOver) {
  LookTimes times(1);
  times.begin();
  times.step(0.01, kAtRest);
  stepsToLook(times, 0.01, kAtRest, 1000);
  EXPECT_EQ(stepsToLook(times, 0.03, kAtRest, 1000), 2);
  EXPECT_EQ(stepsToLook(times, 0.012, kAtRest, 1000), 5);
  EXPECT_EQ(stepsToLook(times, 0.2, kAtRest, 1000), 1);
}

TEST(LookTimes, LongStepsAtRestAreLookedAtInParts) {
  LookTimes times(1);
  times.begin();
  stepsToLook(times, 0.01, kAtRest, 3);
  stepsToLook(times, 0.01, kAtRest, 3);
  times.step(0.22, kAtRest);
  EXPECT_EQ(times.parts(), 5);
  EXPECT_DOUBLE_EQ(times.unseen(), 0.22);
}

TEST(LookTimes, WhatCameBeforeTheRestIsNoPartOfIt) {
  LookTimes times(1);
  times.begin();
  stepsToLook(times, 0.01, kMoves, 1000);
  for (int i = 0; i < 40; ++i) {
    times.step(0.01, kMoves);
    EXPECT_EQ(times.parts(), 1);
  }
  times.step(1e-5, kAtRest);
  times.step(0.01, kAtRest);
  EXPECT_TRUE(times.due(0.01, 1000));
  EXPECT_EQ(times.parts(), 1);
  EXPECT_LT(times.unseen(), 0.011);
  EXPECT_GT(times.sinceLook(), 0.4);
}

TEST(LookTimes, StepsThatNoLongerResolveTheGrowthAreLookedAt) {
  LookTimes times(1000);
  times.begin();
  stepsToLook(times, 0.01, kMoves, 30);
  times.looked(20, 0.01);  // a step is 1/5 of the time constant
  times.step(0.04, kMoves);
  EXPECT_FALSE(times.due(0.04, 30));
  times.step(0.06, kMoves);
  EXPECT_TRUE(times.due(0.06, 30));
  times.looked(20, 0.06);  // it was too long then already
  times.step(0.06, kMoves);
  EXPECT_FALSE(times.due(0.06, 30));
}

TEST(LookTimes, ShortStepsAloneAreNoRest) {
  LookTimes times(1);
  times.begin();
  times.step(1e-3, 100);
  times.step(1e-3, 100);
  EXPECT_TRUE(times.rests());
  EXPECT_FALSE(times.staysAtRest(1e-3)) << "by five tolerances in a twentieth of the interval";
  times.step(1e-3, 10);
  EXPECT_TRUE(times.staysAtRest(1e-3));
  EXPECT_FALSE(times.staysAtRest(0.2)) << "by two in a fifth";
  times.step(1e-3, 0);
  EXPECT_FALSE(times.staysAtRest(1e-3)) << "nothing moves: it has always been there";
}

/// x_i' = rate (x_i - 1).
struct Equal {
  double rate;
  Sizes sizes() const { return {.nx = 3}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    for (Index i = 0; i < 3; ++i) r.x[i] = rate * (p.x[i] - 1.0) - p.k[i];
  }
};

// The motion is judged with one direction per eigenvalue. With one direction for all equal ones, what moves along the
// others would be lost, or what rests would seem to move.
TEST(Growth, EqualEigenvaluesHaveOneDirectionEach) {
  for (const double rate : {5.0, -5.0}) {
    const auto system = makeSystem<double>(Equal{rate});
    for (Index moved = 0; moved < 3; ++moved) {
      State<double> s(system->sizes());
      s.x.setOnes();
      s.x[moved] += 1e-6;
      s.w[moved] = rate * 1e-6;
      Tolerances tolerances;
      tolerances.rtol = tolerances.atol = 1e-4;
      Growth<double> growth(*system, tolerances, {});
      EXPECT_NEAR(growth.speed(s), 5e-6 / 2e-4, 1e-6);
      EXPECT_EQ(growth.rate(s, 10), std::max(rate, 0.0));
      const auto motions = growth.motions(s, 10, 0);
      ASSERT_TRUE(motions);
      EXPECT_EQ(motions->resting, std::max(rate, 0.0)) << moved;
      EXPECT_EQ(motions->living, 5) << moved;
      EXPECT_FALSE(motions->vanished) << moved;
      s.w[moved] = 0;  // nothing is left of it
      const auto nothing = growth.motions(s, 10, 0);
      ASSERT_TRUE(nothing);
      EXPECT_EQ(nothing->living, 0) << moved;
      EXPECT_EQ(nothing->vanished, rate > 0) << moved;
    }
  }
}

// An oscillator that is damped critically: one eigenvector for two eigenvalues.
TEST(Growth, AnEigenvectorThatIsMissingLeavesTheMotionLiving) {
  const auto system =
      makeSystem<double>(SecondOrder{[](const auto& p) { return -10.0 * p.v[0] - 25.0 * (p.u[0] - 1.0); }});
  State<double> s(system->sizes());
  s.u[0] = 1.001;
  s.w[0] = -0.025;
  Growth<double> growth(*system, embedded(1e-4).tolerances, {});
  growth.speed(s);
  EXPECT_EQ(growth.rate(s, 10), 0);
  const auto motions = growth.motions(s, 10, 0);
  ASSERT_TRUE(motions);
  EXPECT_NEAR(motions->living, 5, 1e-6);
  EXPECT_EQ(motions->resting, 0);
}

}  // namespace
}  // namespace irk::test
