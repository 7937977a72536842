#include "irk/collections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "irk/scene.h"
#include "irk/system_check.h"
#include "tests/refusal.h"

namespace irk::test {
namespace {

TEST(Collections, EverySceneBelongsToOne) {
  for (const SceneEntry& entry : sceneCatalogue()) {
    EXPECT_FALSE(entry.collections.empty()) << entry.id;
    EXPECT_TRUE(std::is_sorted(entry.collections.begin(), entry.collections.end())) << entry.id;
    EXPECT_EQ(collectionsOf(entry.id), entry.collections);
  }
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

TEST(Collections, NameTheNearest) {
  const auto message = refusal([] { scenesOf("ipv"); });
  EXPECT_NE(message.find("'ivp'"), std::string::npos) << message;
  EXPECT_TRUE(collectionsOf("no_scene").empty());
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

TEST(Collections, RefuseNamesThatCannotBeWritten) {
  SceneEntry entry = findScene("kepler");
  entry.id = "not_registered";
  entry.collections = {"mine", "My scenes"};
  EXPECT_NE(refusal([&] { registerScene(entry); }).find("collection 'My scenes'"), std::string::npos);
  entry.collections = {};
  entry.parameters.push_back(entry.parameters.front());
  EXPECT_NE(refusal([&] { registerScene(entry); }).find("two parameters are called 'e'"), std::string::npos);
}

TEST(Scenes, ComponentsHaveNamesAndMagnitudes) {
  const auto refused = [](const auto& change) {
    SceneEntry entry = findScene("kepler");
    entry.make = [&, make = entry.make](const Settings& settings) {
      Scene<double> scene = make(settings);
      change(scene);
      return scene;
    };
    return refusal([&] { static_cast<void>(makeScene<double>(entry, {})); });
  };
  EXPECT_EQ(refused([](auto&) {}), "");
  EXPECT_EQ(refused([](auto& scene) { scene.names[1] = scene.names[0]; }),
            "scene kepler: two components are called 'q1'");
  EXPECT_NE(refused([](auto& scene) { scene.names[1] = "q 2"; }).find("component 1 is called 'q 2'"),
            std::string::npos);
  EXPECT_NE(refused([](auto& scene) { scene.names[1] = ""; }).find("component 1 is called ''"), std::string::npos);
  for (const double size : {0.0, -1.0, std::nan("")}) {
    const std::string text =
        refused([size](auto& scene) { scene.scale.setConstant(static_cast<Index>(scene.names.size()), size); });
    EXPECT_NE(text.find("scene kepler: the typical magnitude of q1 is"), std::string::npos) << text;
  }
}

TEST(Scenes, SizesThatNoMemoryHoldsAreRefused) {
  const std::string text = refusal([] { requireSizes({.nu = 2'000'000'000}, {}); });
  EXPECT_NE(text.find("nu = 2000000000: 0 to 10000000"), std::string::npos) << text;
}

}  // namespace
}  // namespace irk::test
