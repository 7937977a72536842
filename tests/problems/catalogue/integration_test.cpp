// Integrates every scene and compares with its reference values.
#include <gtest/gtest.h>

#include "irk/integrator.h"
#include "irk/tableaus.h"
#include "tests/problems/scene_cases.h"
#include "tests/problems/test_set/test_set.h"

namespace irk::test {
namespace {

constexpr double kTolerance = 1e-10;

// Local errors accumulate: over up to 2.5e3 radians of the fastest elastic mode, and by a factor of about 1e3 from
// the first to the last turn of the slider-crank. In Kepler's ten revolutions some 300 steps contribute errors to the
// energy, and an energy error dE changes the phase by 30 pi dE.
double growthOf(const std::string& scene) { return scene == "kepler" ? 3e4 : 1e4; }

IntegratorOptions optionsFor(const std::string& scene) {
  IntegratorOptions o;
  o.tolerances.rtol = o.tolerances.atol = kTolerance;
  o.step.control = StepControl::kPaper;  // with its safety factor of 4
  // Ten revolutions multiply errors by several hundred, which `richardson` sees and reports.
  if (scene == "kepler") o.step.estimate = ErrorEstimate::kEmbedded;
  // Index 3 without mechanical structure cannot reach 1e-10 in double precision.
  if (scene == "index3_nonlinear") {
    o.step.control = StepControl::kFixed;
    o.step.h = 0.01;
    o.newton.kind = NewtonKind::kModified;
  }
  return o;
}

State<double> stateAt(const Scene<double>& scene, const State<double>& from, double t) {
  static const Tableau<double> tableau = makeTableau<double>("radau_iia_5");
  Integrator<double> integrator(scene.system({.discontinuity = Discontinuity::kLocate}), tableau, optionsFor(scene.id),
                                scene.scale);
  const Solution<double> solution = integrator.integrate(from, t);
  EXPECT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
  return solution.state;
}

TEST(Integration, ReachesTheCheckedValues) {
  int compared = 0;
  for (const SceneCase& c : sceneCases()) {
    if (isOfTheTestSet(c.id)) continue;  // tests/problems/test_set
    const auto scene = makeScene<double>(c.id, c.settings);
    State<double> s = scene.start;
    for (const Reference& r : references(c.id, c.settings)) {
      SCOPED_TRACE(c.name() + " at t = " + std::to_string(r.t));
      if (s.t < r.t) s = stateAt(scene, s, r.t);
      if (!hasValue(scene, r.component)) continue;  // of other coordinates
      expectReference(scene, s, r, growthOf(c.id) * kTolerance);
      ++compared;
    }
  }
  EXPECT_GT(compared, 100);
}

// One mechanism in three sets of coordinates has one motion.
TEST(Integration, CoordinatesOfTheSliderCrankAgree) {
  std::vector<double> theta, rate;
  for (const char* coordinates : {"redundant", "absolute", "minimal"}) {
    const SceneCase c{"slider_crank", {{"coordinates", coordinates}}};
    const auto scene = makeScene<double>(c.id, c.settings);
    const State<double> s = stateAt(scene, scene.start, 1);
    theta.push_back(valueOf(scene, "theta", s));
    rate.push_back(valueOf(scene, "theta'", s));
  }
  for (const std::size_t i : {1U, 2U}) {
    EXPECT_NEAR(theta[i], theta[0], growthOf("slider_crank") * kTolerance);
    EXPECT_NEAR(rate[i], rate[0], growthOf("slider_crank") * kTolerance * 10);
  }
}

}  // namespace
}  // namespace irk::test
