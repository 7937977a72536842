// The diagrams of a scene's solution.
#include "experiments/solution/panels.h"

#include <gtest/gtest.h>

#include <algorithm>
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

TEST(Panels, OfASceneWithoutAnyAreSomeOfItsComponents) {
  EXPECT_EQ(headOf("kaps").at("panels"), "\"y1|y1|1\" \"y2|y2|1\"");
  EXPECT_EQ(headOf("kaps").at("time"), "t") << "no units";
  EXPECT_FALSE(headOf("kaps").contains("panels_note"));
  const auto many = headOf("beam_chain");
  const Index components = 2 * makeScene<double>("beam_chain", {}).start.u.size();
  EXPECT_EQ(many.at("panels_note"), "8 of " + std::to_string(components) + " components");
  EXPECT_EQ(std::count(many.at("panels").begin(), many.at("panels").end(), '"'), 16);
  const std::string last = "u" + std::to_string(components / 2) + "'";
  EXPECT_TRUE(containsAll(many.at("panels"), {"|u1|", "|" + last + "|"})) << "from the first to the last";
  EXPECT_EQ(many.at("panels").find("|u2|"), std::string::npos);
}

TEST(Panels, OrbitsHaveTheUnitOfTheirPlane) {
  EXPECT_TRUE(containsAll(headOf("ancf_pendulum").at("panels"), {"\"path of the tip in m|tip_x:tip_y|1\""}));
}

}  // namespace
}  // namespace irk
