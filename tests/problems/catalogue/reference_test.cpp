// problems/reference/*.csv: readable, for existing components, and in agreement with exact solutions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

#include "irk/collections.h"
#include "irk/integrator.h"
#include "irk/misuse.h"
#include "irk/tableaus.h"
#include "tests/problems/scene_cases.h"

namespace irk::test {
namespace {

TEST(Reference, BelongsToAComponentOrOutput) {
  for (const SceneEntry& entry : sceneCatalogue()) {
    const auto scene = makeScene<double>(entry.id);
    for (const Reference& r : references(entry.id)) {
      SCOPED_TRACE(entry.id + " " + r.component);
      EXPECT_TRUE(std::isfinite(valueOf(scene, r.component, scene.start)));
      EXPECT_TRUE(std::isfinite(std::strtod(r.value.c_str(), nullptr)));
      EXPECT_GT(r.accuracy, 0);
      EXPECT_FALSE(r.source.empty());
    }
  }
}

TEST(Reference, IsSortedByTimeWithOneValuePerComponent) {
  for (const SceneCase& c : sceneCases()) {
    const auto all = references(c.id, c.settings);
    for (std::size_t i = 1; i < all.size(); ++i) {
      EXPECT_LE(all[i - 1].t, all[i].t) << c.name();
      for (std::size_t j = 0; j < i; ++j) {
        EXPECT_FALSE(all[i].t == all[j].t && all[i].component == all[j].component) << c.name();
      }
    }
  }
}

// The IVP test set prints y(2) for VDPOL, which starts at (2, 0). This scene's own start, that of HW II (IV.10), gives
// another result from the seventh digit on.
TEST(Reference, DigitsOfTheTestSetsVanDerPolBelongToItsStart) {
  const auto distance = [](const Settings& settings) {
    const auto scene = makeScene<double>("van_der_pol", settings);
    IntegratorOptions o;
    o.tolerances.rtol = o.tolerances.atol = 1e-12;
    Integrator<double> integrator(scene.system({}), makeTableau<double>("radau_iia_7"), o);
    const auto s = integrator.integrate(scene.start, scene.t_end);
    EXPECT_EQ(s.outcome, Outcome::kSuccess) << s.detail;
    return std::hypot(s.state.x[0] - 1.706167732170483, s.state.x[1] + 0.8928097010247975);
  };
  EXPECT_LT(distance({{"start_y2", "0"}}), 1e-9);
  EXPECT_GT(distance({}), 3e-7);
  EXPECT_TRUE(references("van_der_pol", {{"start_y2", "0"}}).empty()) << "the stored ones are of the other start";
}

TEST(Reference, ExactSolutionsAgree) {
  int compared = 0;
  for (const SceneCase& c : sceneCases()) {
    const auto scene = makeScene<BigFloat>(c.id, c.settings);
    if (!scene.exact) continue;
    for (const Reference& r : references(c.id, c.settings)) {
      const BigFloat value = valueOf(scene, r.component, scene.exact(BigFloat(fmt::format("{}", r.t))));
      if (!isfinite(value)) continue;  // the closed form does not give it
      // The guard digit of a value is rounded.
      EXPECT_LE(abs(value - BigFloat(r.value)), BigFloat(1.1 * r.accuracy))
          << c.name() << " " << r.component << " at " << r.t;
      ++compared;
    }
  }
  EXPECT_GT(compared, 100);
}

// Every component of every scene with default settings has a reference at the end. Of the foreign scenes, which only
// the audit runs, a closed form suffices.
TEST(Reference, EverySceneHasItsEnd) {
  const auto foreign = scenesOf("foreign");
  for (const SceneEntry& entry : sceneCatalogue()) {
    const auto scene = makeScene<double>(entry.id);
    const auto all = references(entry.id);
    const bool is_foreign = std::count(foreign.begin(), foreign.end(), entry.id) > 0;
    if (is_foreign && scene.exact) {
      for (const std::string& name : scene.names) {
        EXPECT_TRUE(std::isfinite(valueOf(scene, name, scene.exact(scene.t_end)))) << entry.id << " " << name;
      }
      continue;
    }
    for (const std::string& name : scene.names) {
      EXPECT_TRUE(std::any_of(all.begin(), all.end(),
                              [&](const Reference& r) { return r.component == name && r.t == scene.t_end; }))
          << entry.id << " " << name;
    }
  }
}

// scene,settings,t,component,value,accuracy,source
struct StoredRow {
  std::string scene, settings, t, component, value, accuracy;
};

std::vector<StoredRow> rowsOf(const std::string& file) {
  std::ifstream in(std::string(IRK_SOURCE_DIR) + "/problems/reference/" + file);
  std::vector<StoredRow> rows;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line.starts_with("#") || line.starts_with("scene,")) continue;
    std::istringstream cells(line);
    StoredRow row;
    for (auto* cell : {&row.scene, &row.settings, &row.t, &row.component, &row.value, &row.accuracy}) {
      std::getline(cells, *cell, ',');
    }
    rows.push_back(row);
  }
  return rows;
}

// The values in test_set.csv come from other programs; those of `irk reference` agree with them to the digits that both
// state.
TEST(Reference, ComputedValuesAgreeWithThoseOfOtherPrograms) {
  std::map<std::string, int> compared;
  std::map<std::string, std::vector<StoredRow>> computed;
  for (const StoredRow& other : rowsOf("test_set.csv")) {
    const auto [at, added] = computed.try_emplace(other.scene);
    if (added) at->second = rowsOf(other.scene + ".csv");  // none if there is no such file
    for (const StoredRow& row : at->second) {
      if (row.settings != other.settings || row.component != other.component) continue;
      if (std::strtod(row.t.c_str(), nullptr) != std::strtod(other.t.c_str(), nullptr)) continue;
      EXPECT_LE(abs(BigFloat(row.value) - BigFloat(other.value)), BigFloat(other.accuracy) + BigFloat(row.accuracy))
          << other.scene << " " << other.component << " at " << other.t;
      ++compared[other.scene];
    }
  }
  EXPECT_EQ(compared["andrews"], 54);
  EXPECT_EQ(compared["chemakzo"], 6);
  EXPECT_EQ(compared["e5"], 28);
  EXPECT_EQ(compared["nand"], 448);
  EXPECT_EQ(compared["pump"], 66);
  EXPECT_EQ(compared["transamp"], 11);
  EXPECT_EQ(compared["caraxis"], 10);
  EXPECT_EQ(compared["orego"], 36);
  EXPECT_EQ(compared["pollution"], 20);
}

// Two independent computations agree to 25 digits: closed form and integration share only the equation.
TEST(Reference, EllipticFunctionsAndIntegrationAgreeToTwentyFiveDigits) {
  for (const auto& [id, t_end] : {std::pair{"pendulum", "0.5"}, std::pair{"elastica", "2"}}) {
    SCOPED_TRACE(id);
    const auto scene = makeScene<BigFloat>(id);
    IntegratorOptions options;
    options.tolerances.rtol = options.tolerances.atol = 1e-28;
    options.newton.max_iterations = 100;
    options.newton.kappa = 1e-4;
    Integrator<BigFloat> integrator(scene.system({}), makeTableau<BigFloat>("radau_iia_16"), options, scene.scale);
    const auto solution = integrator.integrate(scene.start, BigFloat(t_end));
    ASSERT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
    const State<BigFloat> exact = scene.exact(BigFloat(t_end));
    for (const std::string& name : scene.names) {
      const BigFloat error = valueOf(scene, name, solution.state) - valueOf(scene, name, exact);
      EXPECT_LT(abs(error), BigFloat("1e-25")) << name;
    }
  }
}

// The elliptic integrals were solved for theta'(L) = 0; the tip deflection is known from the literature.
TEST(Reference, TheElasticaEndsWithoutMoment) {
  const auto scene = makeScene<BigFloat>("elastica");
  const State<BigFloat> tip = scene.exact(BigFloat(2));
  EXPECT_LT(abs(tip.v[0]), BigFloat("1e-45"));
  // Published with twelve decimals; the last one of u_y should be 0, not 1.
  EXPECT_NEAR(static_cast<double>(valueOf(scene, "u_x", tip)), -0.508840369128, 0.6e-12);
  EXPECT_NEAR(static_cast<double>(valueOf(scene, "u_y", tip)), -1.206506882261, 1.1e-12);
}

TEST(Reference, FollowsTheSettings) {
  const auto count = [](const char* id, const Settings& s) { return references(id, s).size(); };
  const std::size_t all = count("slider_crank", {});
  EXPECT_GT(all, 9U);
  EXPECT_EQ(count("slider_crank", {{"coordinates", "absolute"}}), all) << "the same solution";
  EXPECT_EQ(count("slider_crank", {{"L1", "0.10"}}), all) << "the default, written differently";
  EXPECT_EQ(count("slider_crank", {{"L1", "0.11"}}), 0U);
  EXPECT_GT(count("slider_crank", {{"torque_off_at", "0.5"}}), 0U);
  EXPECT_LT(count("slider_crank", {{"torque_off_at", "0.5"}}), all);
  EXPECT_GT(count("ancf_pendulum", {{"elements", "4"}}), 0U);
  EXPECT_EQ(count("ancf_pendulum", {{"elements", "3"}}), 0U);
  EXPECT_THROW(references("ancf_pendulum", {{"element", "4"}}), Misuse);
}

}  // namespace
}  // namespace irk::test
