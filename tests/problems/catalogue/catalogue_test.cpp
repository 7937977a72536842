#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

#include "tests/problems/scene_cases.h"
#include "tests/refusal.h"

namespace irk::test {
namespace {

TEST(Catalogue, IsSortedWithUniqueIds) {
  const auto& entries = sceneCatalogue();
  EXPECT_TRUE(std::is_sorted(entries.begin(), entries.end(), [](const auto& a, const auto& b) { return a.id < b.id; }));
  for (const SceneEntry& entry : entries) {
    EXPECT_FALSE(entry.title.empty()) << entry.id;
    EXPECT_FALSE(entry.shows.empty()) << entry.id;
    EXPECT_EQ(&findScene(entry.id), &entry);
  }
}

// A scene that a file makes and that the catalogue does not list would be missing without a word.
TEST(Catalogue, ListsTheScenesOfAllFiles) {
  std::ptrdiff_t made = 0;
  for (const auto& file : std::filesystem::recursive_directory_iterator(IRK_SOURCE_DIR "/problems")) {
    if (file.path().extension() != ".cpp") continue;
    std::ifstream in(file.path());
    for (std::string line; std::getline(in, line);) made += line.starts_with("IRK_SCENE(");
  }
  EXPECT_EQ(made, std::ranges::count(sceneCatalogue(), false, &SceneEntry::registered));
}

TEST(Catalogue, ScenesAreComplete) {
  for (const SceneCase& c : sceneCases()) {
    SCOPED_TRACE(c.name());
    const auto scene = makeScene<double>(c.id, c.settings);
    const auto precise = makeScene<BigFloat>(c.id, c.settings);
    const Sizes n = scene.sizes();
    const auto components = static_cast<std::size_t>(n.components());
    EXPECT_EQ(scene.id, c.id);
    EXPECT_EQ(scene.names.size(), components);
    EXPECT_EQ(scene.units.size(), components);
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

// The kind that a scene declares for theory agrees with its system.
TEST(Catalogue, KindsAreThoseOfTheSystems) {
  for (const SceneEntry& entry : sceneCatalogue()) {
    SCOPED_TRACE(entry.id);
    const Sizes n = makeScene<double>(entry.id).sizes();
    const bool algebraic = n.nz > 0, constrained = algebraic && n.constraints == n.nz;
    const bool index =
        entry.kind == SceneKind::kIndex1 || entry.kind == SceneKind::kIndex2 || entry.kind == SceneKind::kIndex3;
    EXPECT_EQ(entry.kind == SceneKind::kConstrained, constrained);
    EXPECT_EQ(index, algebraic && !constrained);
    const bool stiff = entry.kind == SceneKind::kStiffTest || entry.kind == SceneKind::kSingularlyPerturbed;
    EXPECT_EQ(stiff, !entry.stiffness.parameter.empty());
    EXPECT_EQ(indexOf(entry.kind) == 0, !algebraic);
    for (const std::string& name : {entry.stiffness.parameter, entry.size.parameter}) {
      const bool known = std::any_of(entry.parameters.begin(), entry.parameters.end(),
                                     [&](const Parameter& p) { return p.name == name && p.choices.empty(); });
      EXPECT_TRUE(known || name.empty()) << name;
    }
  }
}

TEST(Catalogue, ASizeParameterMakesItsUnknowns) {
  int found = 0;
  for (const SceneEntry& entry : sceneCatalogue()) {
    if (entry.size.parameter.empty()) continue;
    ++found;
    EXPECT_GT(entry.size.step, 0) << entry.id;
    const auto unknowns = [&](int size) {
      return makeScene<double>(entry.id, {{entry.size.parameter, std::to_string(size)}}).sizes().n();
    };
    EXPECT_EQ(unknowns(7) - unknowns(4), 3 * entry.size.unknowns) << entry.id;
  }
  EXPECT_GE(found, 2);
}

// Every column of a diagram is a component or an output, and all have one unit.
TEST(Catalogue, PanelsShowWhatTheSceneHas) {
  for (const SceneEntry& entry : sceneCatalogue()) {
    SCOPED_TRACE(entry.id);
    const auto scene = makeScene<double>(entry.id);
    std::map<std::string, std::string> units;
    for (std::size_t i = 0; i < scene.names.size(); ++i) units[scene.names[i]] = scene.units[i];
    for (const auto& output : scene.outputs) units[output.name] = output.unit;
    for (const Panel& panel : entry.panels) {
      std::set<std::string> of_panel;
      for (const std::string& column : panel.columns) {
        const auto colon = column.find(':');
        for (const auto& name : {column.substr(0, colon), column.substr(colon == column.npos ? 0 : colon + 1)}) {
          EXPECT_TRUE(units.contains(name)) << panel.title << ": " << name;
          of_panel.insert(units[name]);
        }
      }
      EXPECT_EQ(of_panel.size(), 1U) << panel.title;
      EXPECT_EQ(panel.unit.empty(), panel.factor == 1) << panel.title;
    }
  }
}

TEST(Catalogue, RatesHaveUnits) {
  const auto unitOf = [](const char* id, const char* name) {
    const auto scene = makeScene<double>(id);
    const auto at = std::find(scene.names.begin(), scene.names.end(), name) - scene.names.begin();
    return scene.units.at(static_cast<std::size_t>(at));
  };
  EXPECT_EQ(unitOf("pendulum", "x"), "m");
  EXPECT_EQ(unitOf("pendulum", "x'"), "m/s");
  EXPECT_EQ(unitOf("pendulum", "lambda"), "N/m");
  EXPECT_EQ(unitOf("ancf_pendulum", "s0_x'"), "1/s");
  EXPECT_EQ(unitOf("elastica", "theta'"), "rad/m");
  EXPECT_EQ(unitOf("kepler", "q1'"), "");
}

TEST(Catalogue, DefaultsAreAllowedValues) {
  for (const SceneEntry& entry : sceneCatalogue()) {
    for (const Parameter& p : entry.parameters) {
      EXPECT_EQ(refusal([&] {
                  makeScene<double>(entry.id, {{p.name, p.default_value}});
                }),
                "")
          << entry.id << " " << p.name;
    }
  }
}

}  // namespace
}  // namespace irk::test
