// The scenes with all treatments of switches and in all formulations.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/problems/scene_run.h"

namespace irk::test {
namespace {

// The flight is a parabola, so steps are long. If a step begins just before the contact, all its stages may lie on
// the floor, and step doubling does not detect the contact. The default estimate does.
TEST(Modes, OfTheBouncingMass) {
  const auto scene = makeScene<double>("bouncing_mass");
  const State<double> exact = scene.exact(0.5);
  const auto error = [&](Discontinuity mode, double tolerance, const char* method) {
    const Result r = run({"bouncing_mass", {}}, 0.5, mode, tolerance, method);
    EXPECT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
    return std::max(std::abs(r.solution.state.u[0] - exact.u[0]) / scene.scale[0],
                    std::abs(r.solution.state.v[0] - exact.v[0]) / scene.scale[1]);
  };
  for (const double tolerance : {1e-4, 1e-6, 1e-8}) {
    for (const auto& mode : named<Discontinuity>()) {
      EXPECT_LT(error(mode.value, tolerance, "radau_iia_5"), 300 * tolerance) << mode.id;
    }
  }
  for (const Discontinuity mode : {Discontinuity::kIgnore, Discontinuity::kIterate, Discontinuity::kLocate}) {
    EXPECT_LT(error(mode, 1e-10, "radau_iia_5"), 300 * 1e-10) << idOf(mode);
    EXPECT_LT(error(mode, 1e-10, "radau_iia_9"), 300 * 1e-10) << idOf(mode);
  }
}

// With blended modes nothing switches, and the width of the blend bounds the error.
TEST(Modes, RegularisationsTendToTheSwitchedScene) {
  struct Case {
    SceneCase scene;
    double t;
    const char *coarse, *fine;
  };
  const std::vector<Case> cases = {
      {{"slider_crank", {{"torque_off_at", "0.5"}}}, 1, "1e-2", "1e-3"},
      {{"stick_slip", {}}, 20, "1e-3", "1e-4"},
      {{"elastoplastic", {}}, 1, "1e-1", "1e-2"},
      {{"hydraulic_arm", {}}, 0.4, "1e-3", "1e-4"},
      {{"hydraulic_manipulator", {}}, 2.1, "4e-4", "4e-5"},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(c.scene.name());
    const auto exact = run(c.scene, c.t, Discontinuity::kLocate).solution.state;
    const auto error = [&](const char* smoothing) {
      SceneCase smoothed = c.scene;
      smoothed.settings["smoothing"] = smoothing;
      const Result r = run(smoothed, c.t, Discontinuity::kSmooth);
      EXPECT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
      EXPECT_TRUE(r.events.empty());
      return std::abs(r.solution.state.u[0] - exact.u[0]);
    };
    const double coarse = error(c.coarse), fine = error(c.fine);
    EXPECT_LT(fine, coarse / 3);
  }
}

// Switches act through accelerations and multipliers, in every formulation of the constraint.
TEST(Modes, FormulationsOfTheMechatronicCrankAgree) {
  const auto scene = makeScene<double>("mechatronic_crank");
  IntegratorOptions options;
  for (const Formulation formulation : {Formulation::kIndex1, Formulation::kIndex2, Formulation::kIndex2Projected,
                                        Formulation::kIndex3, Formulation::kGgl}) {
    // In index 3 velocities have round-off divided by h: short steps after a switch cannot reach 1e-9, and if they
    // cannot reach 1e-8 either the run must fail.
    const double tol = formulation == Formulation::kIndex3 ? 1e-8 : 1e-9;
    options.tolerances.rtol = options.tolerances.atol = tol;
    const auto system = scene.system({formulation, ConstraintScaling::kOn, Discontinuity::kLocate});
    Vec<double> scale = Vec<double>::Ones(system->sizes().components());  // GGL's mu: 1
    scale.head(scene.scale.size()) = scene.scale;
    Integrator<double> integrator(system, makeTableau<double>("radau_iia_5"), options, scale);
    const Solution<double> s = integrator.integrate(scene.start, 0.5);
    if (formulation == Formulation::kIndex3 && s.outcome == Outcome::kStepTooSmall) continue;
    ASSERT_EQ(s.outcome, Outcome::kSuccess) << idOf(formulation) << s.detail;
    EXPECT_EQ(s.counters.located_events, 8) << idOf(formulation);
    EXPECT_NEAR(s.state.u[0], 5.0473797435, 1e3 * tol) << idOf(formulation);
    EXPECT_NEAR(s.state.v[0], 7.8072077607, 1e4 * tol) << idOf(formulation);
  }
}

TEST(Modes, MemoriesHaveNoRegularisation) {
  for (const char* id : {"sampled_control", "dc_motor_chopper", "mechatronic_crank"}) {
    const auto scene = makeScene<double>(id);
    EXPECT_THROW(scene.system({.discontinuity = Discontinuity::kSmooth}), Misuse) << id;
  }
}

}  // namespace
}  // namespace irk::test
