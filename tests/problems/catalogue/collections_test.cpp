#include "irk/collections.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "irk/scene.h"

namespace irk::test {
namespace {

TEST(Collections, EverySceneBelongsToOne) {
  for (const SceneEntry& entry : sceneCatalogue()) {
    EXPECT_FALSE(entry.collections.empty()) << entry.id;
    EXPECT_TRUE(std::is_sorted(entry.collections.begin(), entry.collections.end())) << entry.id;
    EXPECT_EQ(collectionsOf(entry.id), entry.collections);
  }
  EXPECT_TRUE(collectionsOf("no_scene").empty());
  EXPECT_EQ(collections(), (std::vector<std::string>{"foreign", "ivp", "multibody", "probes", "switching"}));
}

TEST(Collections, HoldTheirScenesInTheOrderOfTheCatalogue) {
  const auto ivp = scenesOf("ivp");
  EXPECT_EQ(ivp.size(), 17U);
  EXPECT_TRUE(std::is_sorted(ivp.begin(), ivp.end()));
  for (const char* id : {"andrews", "hires", "pendulum", "slider_crank_flexible"}) {
    EXPECT_EQ(std::count(ivp.begin(), ivp.end(), id), 1) << id;
  }
  EXPECT_EQ(std::count(ivp.begin(), ivp.end(), "stick_slip"), 0);
  for (const std::string& name : collections()) {
    for (const std::string& id : scenesOf(name)) EXPECT_EQ(findScene(id).id, id);
  }
}

// Every scene with switches is in the collection `switching`, except the slider-crank: with its defaults the torque
// never switches; and the foreign scenes, which are in no other collection, since studies of the paper run those.
TEST(Collections, ScenesWithSwitchesAreTogether) {
  const auto switching = scenesOf("switching"), foreign = scenesOf("foreign");
  EXPECT_EQ(foreign.size(), 14U);
  for (const SceneEntry& entry : sceneCatalogue()) {
    if (std::count(foreign.begin(), foreign.end(), entry.id) > 0) {
      EXPECT_EQ(entry.collections, std::vector<std::string>{"foreign"}) << entry.id;
      continue;
    }
    const bool switches = makeScene<double>(entry.id).sizes().switches > 0 && entry.id != "slider_crank";
    const bool listed = std::count(switching.begin(), switching.end(), entry.id) > 0;
    EXPECT_TRUE(listed || !switches) << entry.id;
  }
}

// The scenes of the test set name it, and their index is that of their equations.
TEST(Collections, ScenesSayWhereTheyAreDescribed) {
  for (const std::string& id : scenesOf("ivp")) EXPECT_FALSE(findScene(id).literature.empty()) << id;
  const auto index = [](const char* id) { return indexOf(findScene(id).kind); };
  EXPECT_EQ(index("orego"), 0);
  EXPECT_EQ(index("van_der_pol"), 0);
  EXPECT_EQ(index("transamp"), 1);
  EXPECT_EQ(index("pump"), 2);
  EXPECT_EQ(index("index3_nonlinear"), 3);
  EXPECT_EQ(index("andrews"), 3);
}

}  // namespace
}  // namespace irk::test
