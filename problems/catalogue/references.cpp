// Reads problems/reference/*.csv, the rows of a scene when they are first asked for. The text is embedded at build time
// (catalogue/embedded.cpp.in).
#include <algorithm>
#include <cstdlib>
#include <functional>
#include <map>
#include <mutex>
#include <sstream>
#include <stdexcept>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "irk/scene_file.h"
#include "problems/catalogue/embedded.h"

namespace irk {
namespace {

struct Row {
  Settings settings;
  Reference reference;
};

/// The rows of one scene. Most programs need those of one scene, and all together take milliseconds.
struct SceneRows {
  std::vector<std::string_view> lines;
  mutable std::once_flag parsed;
  mutable std::vector<Row> rows;  // by time, the most accurate first
};
using RowsByScene = std::map<std::string, SceneRows, std::less<>>;

// Parses `name=value` pairs separated by blanks.
Settings parseSettings(const std::string& text) {
  Settings settings;
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos) throw std::logic_error("reference setting: " + word);
    settings[word.substr(0, equals)] = word.substr(equals + 1);
  }
  return settings;
}

// Parses a line `scene,settings,t,component,value,accuracy,source`. The source is the rest of the line.
Row parseRow(const std::string& line) {
  constexpr int kFields = 6;
  std::string fields[kFields];
  std::istringstream in(line);
  for (std::string& field : fields) {
    if (!std::getline(in, field, ',')) throw std::logic_error("reference line: " + line);
  }
  Row row{parseSettings(fields[1]), {}};
  row.reference.t = std::strtod(fields[2].c_str(), nullptr);
  row.reference.component = fields[3];
  row.reference.value = fields[4];
  row.reference.accuracy = std::strtod(fields[5].c_str(), nullptr);
  std::getline(in, row.reference.source);
  return row;
}

// The lines of each scene, whose id is their first field.
RowsByScene linesByScene() {
  RowsByScene by_scene;
  const std::string_view text = kEmbeddedReferences;
  for (std::size_t at = 0, end = 0; at < text.size(); at = end + 1) {
    end = std::min(text.find('\n', at), text.size());
    const std::string_view line = text.substr(at, end - at);
    if (line.empty() || line[0] == '#' || line.starts_with("scene,settings,")) continue;
    by_scene[std::string(line.substr(0, line.find(',')))].lines.push_back(line);
  }
  return by_scene;
}

const std::vector<Row>& rowsOf(const SceneRows& scene) {
  std::call_once(scene.parsed, [&scene] {
    for (const std::string_view line : scene.lines) scene.rows.push_back(parseRow(std::string(line)));
    std::stable_sort(scene.rows.begin(), scene.rows.end(), [](const Row& a, const Row& b) {
      return std::tie(a.reference.t, a.reference.accuracy) < std::tie(b.reference.t, b.reference.accuracy);
    });
  });
  return scene.rows;
}

// Compares numbers as numbers ("0.50" equals "0.5") and words as text.
bool sameValue(const std::string& a, const std::string& b) {
  char* end_a = nullptr;
  char* end_b = nullptr;
  const double x = std::strtod(a.c_str(), &end_a), y = std::strtod(b.c_str(), &end_b);
  const bool numbers = *end_a == '\0' && *end_b == '\0';
  return numbers ? x == y : a == b;
}

}  // namespace

std::vector<Reference> references(std::string_view id, const Settings& settings) {
  static const RowsByScene scenes = linesByScene();
  const SceneEntry& entry = findScene(id);
  const Settings wanted = completedSettings(id, entry.parameters, settings);
  std::vector<Reference> found;
  const auto scene = scenes.find(id);
  if (scene == scenes.end()) return found;
  for (const Row& row : rowsOf(scene->second)) {
    const Settings given = completedSettings(id, entry.parameters, row.settings);
    const bool match = std::all_of(entry.parameters.begin(), entry.parameters.end(), [&](const Parameter& p) {
      return !p.changes_solution || sameValue(wanted.at(p.name), given.at(p.name));
    });
    const bool known = std::any_of(found.begin(), found.end(), [&](const Reference& r) {
      return r.t == row.reference.t && r.component == row.reference.component;
    });
    if (match && !known) found.push_back(row.reference);
  }
  return found;
}

}  // namespace irk
