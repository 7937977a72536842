// problems/reference/*.csv: readable, attached to components, in agreement with exact solutions.
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/misuse.h"
#include "tests/problems/scene_cases.h"

namespace irk::test {
namespace {

// In the order of the components, then of the outputs.
double valueOf(const Scene<double>& scene, const std::string& name, const State<double>& s) {
  Vec<double> y(scene.sizes().components());
  y << s.u, s.v, s.x, s.z();
  for (std::size_t i = 0; i < scene.names.size(); ++i) {
    if (scene.names[i] == name) return y[static_cast<Index>(i)];
  }
  for (const auto& output : scene.outputs) {
    if (output.name == name) return output.value(s);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

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

TEST(Reference, ExactSolutionsAgree) {
  for (const SceneCase& c : sceneCases()) {
    const auto scene = makeScene<double>(c.id, c.settings);
    if (!scene.exact) continue;
    for (const Reference& r : references(c.id, c.settings)) {
      const double value = std::strtod(r.value.c_str(), nullptr);
      EXPECT_NEAR(valueOf(scene, r.component, scene.exact(r.t)), value, r.accuracy + 100 * kEps)
          << c.name() << " " << r.component << " at " << r.t;
    }
  }
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
