#include <gtest/gtest.h>

#include <array>
#include <string>

#include "irk/misuse.h"
#include "irk/scene_lanes.h"

namespace irk::test {
namespace {

TEST(SceneLanes, HaveTheSizesOfTheScene) {
  int scenes = 0;
  for (const SceneEntry& entry : sceneCatalogue()) {
    if (!entry.make_lanes) continue;
    ++scenes;
    const std::array<Settings, kLanes> settings{};
    const Sizes lanes = makeLanes(entry, settings, {})->sizes(), scene = makeScene<double>(entry.id).sizes();
    EXPECT_EQ(lanes.nu, scene.nu) << entry.id;
    EXPECT_EQ(lanes.nx, scene.nx) << entry.id;
    EXPECT_EQ(lanes.nz, scene.nz) << entry.id;
  }
  EXPECT_GE(scenes, 13);
}

TEST(SceneLanes, AreRefusedNamingTheScenesThatHaveSome) {
  try {
    requireLanes(findScene("bouncing_mass"), {});
    FAIL();
  } catch (const Misuse& misuse) {
    for (const char* part : {"scene bouncing_mass has no lanes", "make_lanes", "caraxis, chemakzo, dahlquist"}) {
      EXPECT_NE(std::string(misuse.what()).find(part), std::string::npos) << misuse.what();
    }
  }
}

}  // namespace
}  // namespace irk::test
