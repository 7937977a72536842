// The mass that slides along an ANCF beam: two forms that agree, constraints, energy, a beam that does not bend.
#include <gtest/gtest.h>

#include "tests/problems/mechanisms/motion.h"
#include "tests/problems/scene_run.h"

namespace irk::test {
namespace {

// Constraints with multipliers, whose element is a coordinate, and the inserted mass, whose element is a discrete
// state, share the beam only. They agree beyond the switch.
TEST(SlidingMass, JointAndInsertedMassAgreeToFourteenDigits) {
  Settings settings = {{"start", "0.485"}, {"v0", "2"}};
  const auto joint = makeScene<BigFloat>("sliding_mass", settings);
  settings["coordinates"] = "inserted";
  const auto inserted = makeScene<BigFloat>("sliding_mass", settings);
  const BigFloat t("0.015");
  const auto a = stateAfter<BigFloat>(joint, t, 1e-18, 9), b = stateAfter<BigFloat>(inserted, t, 1e-18, 9);
  EXPECT_EQ(a.d[0], 1);
  EXPECT_EQ(b.d[0], 1);
  for (const char* name : {"s", "s'", "x", "y", "x'", "y'", "tip_x", "tip_y", "tip_x'", "tip_y'", "s1_y'", "energy"}) {
    EXPECT_LT(abs(valueOf(joint, name, a) - valueOf(inserted, name, b)), BigFloat("1e-14")) << name;
  }
}

// In index 3 the small steps after a switch may end a run (step too small) by its last digits, in about one of fifty.
TEST(SlidingMass, KeepsItsEnergyAndConstraints) {
  int ended = 0;
  for (const char* coordinates : {"joint", "inserted"}) {
    for (const char* elements : {"1", "2", "4"}) {
      SCOPED_TRACE(std::string(coordinates) + " " + elements);
      const auto scene = makeScene<double>("sliding_mass", {{"coordinates", coordinates}, {"elements", elements}});
      for (const Formulation formulation : {Formulation::kIndex3, Formulation::kIndex2, Formulation::kGgl}) {
        const bool is_index3 = formulation == Formulation::kIndex3;
        const Drift drift = driftOf(scene, is_index3 ? 1e-7 : 1e-9, formulation);
        ended += drift.outcome != Outcome::kSuccess;
        EXPECT_TRUE(drift.outcome == Outcome::kSuccess || (is_index3 && drift.outcome == Outcome::kStepTooSmall));
        EXPECT_LT(drift.invariants.at("energy"), 1e-7);
        EXPECT_LT(drift.position, 1e-8);
      }
    }
  }
  EXPECT_LE(ended, 2);
}

// The mass crosses each node once, where s is that of the node.
TEST(SlidingMass, ChangesItsElementAtTheNodes) {
  for (const char* coordinates : {"joint", "inserted"}) {
    const SceneCase c{"sliding_mass", {{"coordinates", coordinates}, {"elements", "4"}, {"start", "0.2"}, {"v0", "2"}}};
    const auto scene = makeScene<double>(c.id, c.settings);
    const Result r = run(c, scene.t_end, Discontinuity::kLocate);
    ASSERT_EQ(r.events.size(), 3U);
    double node = 0.25;
    for (const Event& event : r.events) {
      EXPECT_EQ(event.name, "next element");
      const auto there = run(c, event.t, Discontinuity::kLocate);
      EXPECT_NEAR(valueOf(scene, "s", there.solution.state), node, 1e-8);
      node += 0.25;
    }
  }
}

TEST(SlidingMass, SlidesAlongAStiffBeamAtConstantSpeed) {
  const auto scene = makeScene<double>("sliding_mass", {{"E", "1e11"}, {"v0", "2"}});
  const auto s = stateAfter<double>(scene, 0.2, 1e-6, 5);
  EXPECT_NEAR(valueOf(scene, "s", s), 0.7, 1e-4);
  EXPECT_NEAR(valueOf(scene, "s'", s), 2, 1e-3);
  EXPECT_NEAR(valueOf(scene, "y", s), 0, 1e-4);
}

// A mass that is thrown back crosses the node the other way.
TEST(SlidingMass, GoesBack) {
  for (const char* coordinates : {"joint", "inserted"}) {
    const SceneCase c{"sliding_mass",
                      {{"coordinates", coordinates}, {"start", "0.8"}, {"v0", "-4"}, {"elements", "2"}}};
    const Result r = run(c, 0.1, Discontinuity::kLocate);
    ASSERT_EQ(r.solution.outcome, Outcome::kSuccess);
    ASSERT_EQ(r.events.size(), 1U);
    EXPECT_EQ(r.events[0].name, "previous element");
    EXPECT_EQ(r.solution.state.d[0], 0);
  }
}

// The curvature jumps at the node, and with it the force: over 2e-6 s far more than before and after.
TEST(SlidingMass, TheForceJumpsBetweenElements) {
  const auto scene = makeScene<double>("sliding_mass");
  const Result r = run({"sliding_mass", {}}, scene.t_end, Discontinuity::kLocate);
  ASSERT_EQ(r.events.size(), 1U);
  const auto force = [&](double t) { return stateAfter<double>(scene, t, 1e-10, 5).z()[1]; };
  const double step = 2e-6, node = r.events[0].t - step / 2;
  const double before = force(node) - force(node - step), across = force(node + step) - force(node);
  const double after = force(node + 2 * step) - force(node + step);
  EXPECT_GT(std::abs(across), 0.01);
  EXPECT_GT(std::abs(across), 20 * std::abs(before));
  EXPECT_GT(std::abs(across), 20 * std::abs(after));
}

}  // namespace
}  // namespace irk::test
