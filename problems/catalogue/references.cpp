// Parses problems/reference/*.csv once. The text is embedded at build time (catalogue/embedded.cpp.in).
#include <algorithm>
#include <cstdlib>
#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "irk/scene_file.h"
#include "problems/catalogue/embedded.h"

namespace irk {
namespace {

struct Row {
  std::string scene;
  Settings settings;
  Reference reference;
};
using RowsByScene = std::map<std::string, std::vector<Row>, std::less<>>;

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
  Row row{fields[0], parseSettings(fields[1]), {}};
  row.reference.t = std::strtod(fields[2].c_str(), nullptr);
  row.reference.component = fields[3];
  row.reference.value = fields[4];
  row.reference.accuracy = std::strtod(fields[5].c_str(), nullptr);
  std::getline(in, row.reference.source);
  return row;
}

// Each scene's rows by time, the most accurate first.
RowsByScene parseRows() {
  std::vector<Row> rows;
  std::istringstream in{std::string(kEmbeddedReferences)};
  for (std::string line; std::getline(in, line);) {
    const bool head = line.starts_with("scene,settings,");
    if (!line.empty() && line[0] != '#' && !head) rows.push_back(parseRow(line));
  }
  std::stable_sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
    return std::tie(a.reference.t, a.reference.accuracy) < std::tie(b.reference.t, b.reference.accuracy);
  });
  RowsByScene by_scene;
  for (Row& row : rows) by_scene[row.scene].push_back(std::move(row));
  return by_scene;
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
  static const RowsByScene rows = parseRows();
  const SceneEntry& entry = findScene(id);
  const Settings wanted = completedSettings(id, entry.parameters, settings);
  std::vector<Reference> found;
  const auto of_scene = rows.find(id);
  if (of_scene == rows.end()) return found;
  for (const Row& row : of_scene->second) {
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
