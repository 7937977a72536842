#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "irk/misuse.h"
#include "tests/problems/scene_cases.h"

namespace irk::test {
namespace {

std::string misuseOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const Misuse& misuse) {
    return misuse.what();
  }
  return "";
}

TEST(Catalogue, IsSortedWithUniqueIds) {
  const auto& entries = sceneCatalogue();
  EXPECT_TRUE(std::is_sorted(entries.begin(), entries.end(),
                             [](const auto& a, const auto& b) { return a.id < b.id; }));
  for (const SceneEntry& entry : entries) {
    EXPECT_FALSE(entry.title.empty()) << entry.id;
    EXPECT_FALSE(entry.shows.empty()) << entry.id;
    EXPECT_EQ(&findScene(entry.id), &entry);
  }
}

TEST(Catalogue, ScenesAreComplete) {
  for (const SceneCase& c : sceneCases()) {
    SCOPED_TRACE(c.name());
    const auto scene = makeScene<double>(c.id, c.settings);
    const auto precise = makeScene<mp50>(c.id, c.settings);
    const Sizes n = scene.sizes();
    const auto components = static_cast<std::size_t>(n.components());
    EXPECT_EQ(scene.id, c.id);
    EXPECT_EQ(scene.names.size(), components);
    EXPECT_EQ(scene.scale.size(), n.components());
    EXPECT_GT(scene.scale.minCoeff(), 0);
    EXPECT_GT(scene.t_end, 0);
    EXPECT_EQ(precise.names, scene.names);
    EXPECT_EQ(precise.t_end, scene.t_end);
    std::set<std::string> names(scene.names.begin(), scene.names.end());
    for (const auto& output : scene.outputs) {
      names.insert(output.name);
      EXPECT_TRUE(std::isfinite(output.value(scene.start))) << output.name;
    }
    EXPECT_EQ(names.size(), components + scene.outputs.size()) << "names are unique";
    EXPECT_LE(n.constraints, n.nz);
    for (Index i = 0; i < n.nu; ++i) {
      const auto u = static_cast<std::size_t>(i), v = static_cast<std::size_t>(n.nu + i);
      EXPECT_EQ(scene.names[v], scene.names[u] + "'");
    }
  }
}

TEST(Catalogue, NamesTheNearestScene) {
  const std::string message = misuseOf([] { makeScene<double>("slidercrank"); });
  EXPECT_NE(message.find("did you mean 'slider_crank'"), std::string::npos) << message;
}

TEST(Catalogue, NamesTheNearestParameter) {
  const std::string message = misuseOf([] {
    makeScene<double>("slider_crank", {{"coordinate", "minimal"}});
  });
  EXPECT_NE(message.find("did you mean 'coordinates'"), std::string::npos) << message;
  EXPECT_NE(misuseOf([] {
              makeScene<double>("hires", {{"k", "1"}});
            }).find("no parameters"),
            std::string::npos);
}

TEST(Catalogue, RefusesAScalarThatTheSceneDoesNotOffer) {
  const std::string message = misuseOf([] { makeScene<mp100>("kepler"); });
  for (const char* part : {"mp100", "scene kepler", "double and mp50", "riccati_tracking"}) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

TEST(Catalogue, RefusesValuesOutOfRange) {
  const std::string message = misuseOf([] { makeScene<mp50>("kepler", {{"e", "1.5"}}); });
  EXPECT_NE(message.find("e = '1.5'"), std::string::npos) << message;
  EXPECT_NE(message.find("[0, 0.99]"), std::string::npos) << message;
}

TEST(Catalogue, RefusesWhatIsNoNumber) {
  for (const char* text : {"", "one", "1x", "nan", "inf"}) {
    EXPECT_NE(misuseOf([&] { makeScene<double>("stick_slip", {{"k", text}}); }), "") << text;
  }
  EXPECT_NE(misuseOf([] { makeScene<double>("ancf_pendulum", {{"elements", "2.5"}}); }), "");
}

TEST(Catalogue, RefusesUnknownWords) {
  const std::string message = misuseOf([] {
    makeScene<double>("hydraulic_arm", {{"reference", "smoth"}});
  });
  EXPECT_NE(message.find("did you mean 'smooth'"), std::string::npos) << message;
}

// An empty function would be called: std::bad_function_call.
TEST(Catalogue, RefusesScalarsThatASceneDoesNotOffer) {
  SceneEntry entry = findScene("kepler");
  EXPECT_NO_THROW(makeScene<mp50>(entry, {}));
  entry.id = "mine";
  entry.make_mp50 = {};
  const std::string message = misuseOf([&] { makeScene<mp50>(entry, {}); });
  EXPECT_EQ(message.find("scalar = 'mp50': scene mine offers double; with mp50: "), 0U) << message;
  EXPECT_EQ(misuseOf([&] { makeScene<double>(entry, {}); }), "");
  entry.make = {};
  EXPECT_EQ(misuseOf([&] { makeScene<double>(entry, {}); }).find("scalar = 'double': scene mine offers none"), 0U);
  entry.make = [](const Settings&) {
    auto scene = makeScene<double>("kepler");
    scene.system = {};
    return scene;
  };
  EXPECT_EQ(misuseOf([&] { makeScene<double>(entry, {}); }), "scene mine makes no system");
}

TEST(Catalogue, DefaultsAreAllowedValues) {
  for (const SceneEntry& entry : sceneCatalogue()) {
    for (const Parameter& p : entry.parameters) {
      EXPECT_EQ(misuseOf([&] {
                  makeScene<double>(entry.id, {{p.name, p.default_value}});
                }),
                "")
          << entry.id << " " << p.name;
    }
  }
}

}  // namespace
}  // namespace irk::test
