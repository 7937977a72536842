// The scenes of the IVP test set reach the values of other programs: problems/reference/test_set.csv.
#include "tests/problems/test_set/test_set.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>

#include "irk/integrator.h"
#include "irk/tableaus.h"

namespace irk::test {
namespace {

// Applies the changes that are declared for the time of the state. Neither the integration that ends at this time nor
// the one that begins at it applies them.
void passTimes(const System<double>& system, State<double>& state) {
  const auto times = system.times();
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (times[i] == state.t) system.onTime(static_cast<Index>(i), state);
  }
}

// Values and scales of the components and outputs by name.
std::map<std::string, std::pair<double, double>> valuesOf(const Scene<double>& scene, const State<double>& s) {
  Vec<double> y(scene.sizes().components());
  y << s.u, s.v, s.x, s.z();
  std::map<std::string, std::pair<double, double>> values;
  for (std::size_t i = 0; i < scene.names.size(); ++i) {
    const auto row = static_cast<Index>(i);
    values[scene.names[i]] = {y[row], scene.scale[row]};
  }
  for (const auto& output : scene.outputs) values[output.name] = {output.value(s), 1};
  return values;
}

// Local errors accumulate: at most this many tolerances at the end.
constexpr double kGrowth = 1e3;

// The two most expensive scenes use an error estimate that costs one solve per step, and keep their Jacobian longer.
IntegratorOptions optionsOf(const TestSetCase& c) {
  IntegratorOptions options;
  options.tolerances.rtol = options.tolerances.atol = c.tolerance;
  if (c.id != std::string_view("beam") && c.id != std::string_view("ringmod")) return options;
  options.step.estimate = ErrorEstimate::kEmbedded;
  options.solver = StageSolverKind::kEigen;
  options.jacobian_point = JacobianPoint::kPredicted;
  options.newton.kind = NewtonKind::kBroyden;
  return options;
}

class TestSet : public testing::TestWithParam<TestSetCase> {};

TEST_P(TestSet, ReachesTheValuesOfOtherPrograms) {
  const TestSetCase& c = GetParam();
  const auto scene = makeScene<double>(c.id, c.settings());
  const auto system = scene.system({});
  const IntegratorOptions options = optionsOf(c);
  Integrator<double> integrator(system, makeTableau<double>("radau_iia_5"), options, scene.scale);
  State<double> state = scene.start;
  int compared = 0;
  for (const Reference& r : references(c.id, c.settings())) {
    if (state.t < r.t) {
      const auto solution = integrator.integrate(state, r.t);
      ASSERT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
      state = solution.state;
      passTimes(*system, state);
    }
    const auto [value, scale] = valuesOf(scene, state).at(r.component);
    const double wanted = std::strtod(r.value.c_str(), nullptr);
    const double size = std::max(std::abs(wanted), scale);
    EXPECT_NEAR(value, wanted, kGrowth * c.tolerance * size + r.accuracy) << r.component << " at " << r.t;
    ++compared;
  }
  EXPECT_GE(compared, 3);
}

INSTANTIATE_TEST_SUITE_P(, TestSet, testing::ValuesIn(kTestSet), [](const auto& named) {
  return std::string(named.param.id) +
         (*named.param.setting == '\0' ? "" : "_with_" + std::string(named.param.setting));
});

}  // namespace
}  // namespace irk::test
