// The diagrams of a scene's solution.
#include "experiments/solution/panels.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/experiments/support.h"

namespace irk {
namespace {

std::map<std::string, std::string> headOf(const char* id, const Settings& settings = {}) {
  const TableHead head = panelHead(findScene(id), makeScene<double>(id, settings));
  return {head.begin(), head.end()};
}

TEST(Panels, HaveLabelsWithUnits) {
  const auto arm = headOf("hydraulic_arm");
  EXPECT_EQ(arm.at("time"), "t in s");
  EXPECT_EQ(arm.at("panels"),
            "\"angle in rad|angle|1\" \"angular velocity in rad/s|angle'|1\" \"pressures in MPa|p0 p1|1e-06\"");
}

TEST(Panels, LeaveOutWhatSettingsTakeAway) {
  const auto minimal = headOf("slider_crank", {{"coordinates", "minimal"}}).at("panels");
  EXPECT_TRUE(containsAll(minimal, {"\"angles in rad|theta phi|1\"", "\"slider in m|x3|1\""})) << "phi is an output";
  EXPECT_EQ(minimal.find("multiplier"), minimal.npos);
  EXPECT_TRUE(containsAll(headOf("slider_crank").at("panels"), {"\"multiplier in N|lambda|1\""}));
}

TEST(Panels, OfASceneWithoutAnyAreItsFirstComponents) {
  EXPECT_EQ(headOf("kaps").at("panels"), "\"y1|y1|1\" \"y2|y2|1\"");
  EXPECT_EQ(headOf("kaps").at("time"), "t") << "no units";
  const auto many = headOf("beam_chain").at("panels");
  EXPECT_TRUE(containsAll(many, {"|u8|"}));
  EXPECT_EQ(many.find("|u9|"), many.npos);
}

TEST(Panels, OrbitsHaveTheUnitOfTheirPlane) {
  EXPECT_TRUE(containsAll(headOf("ancf_pendulum").at("panels"), {"\"path of the tip in m|tip_x:tip_y|1\""}));
}

}  // namespace
}  // namespace irk
