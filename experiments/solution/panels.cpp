#include "experiments/solution/panels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>

namespace irk {
namespace {

constexpr std::size_t kMaxPanels = 8;  // where the scene names none

std::string withUnit(const std::string& title, const std::string& unit) {
  return unit.empty() ? title : title + " in " + unit;
}

std::vector<Panel> onePerColumn(const std::vector<std::string>& columns) {
  std::vector<Panel> panels;
  for (const auto& column : columns) {
    if (panels.size() < kMaxPanels) panels.push_back({column, {column}});
  }
  return panels;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> namesAndUnits(const Scene<double>& scene) {
  std::vector<std::pair<std::string, std::string>> columns;
  for (std::size_t i = 0; i < scene.names.size(); ++i) {
    columns.emplace_back(scene.names[i], i < scene.units.size() ? scene.units[i] : "");
  }
  for (const auto& output : scene.outputs) columns.emplace_back(output.name, output.unit);
  return columns;
}

TableHead panelHead(const SceneEntry& entry, const Scene<double>& scene) {
  std::vector<std::string> columns;
  std::map<std::string, std::string, std::less<>> units;
  for (const auto& [name, unit] : namesAndUnits(scene)) {
    columns.push_back(name);
    units[name] = unit;
  }
  std::string text;
  for (const Panel& panel : entry.panels.empty() ? onePerColumn(columns) : entry.panels) {
    std::vector<std::string> there;
    std::string unit = panel.unit;
    for (const std::string& column : panel.columns) {
      const std::string first = column.substr(0, column.find(':'));
      if (!units.contains(first)) continue;
      there.push_back(column);
      if (panel.unit.empty()) unit = units[first];
    }
    if (there.empty()) continue;
    text += fmt::format("{}\"{}|{}|{:g}\"", text.empty() ? "" : " ", withUnit(panel.title, unit), fmt::join(there, " "),
                        panel.factor);
  }
  return {{"time", withUnit("t", scene.time_unit)}, {"panels", text}};
}

}  // namespace irk
