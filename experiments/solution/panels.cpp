#include "experiments/solution/panels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

namespace irk {
namespace {

constexpr std::size_t kMaxPanels = 8;  // where the scene names none

std::string withUnit(const std::string& title, const std::string& unit) {
  return unit.empty() ? title : title + " in " + unit;
}

// The first columns; of a large system, as the points of a grid, some from the first to the last.
std::vector<Panel> onePerColumn(const std::vector<std::string>& columns) {
  const std::size_t count = std::min(kMaxPanels, columns.size());
  const bool large = columns.size() > 4 * kMaxPanels;
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& column = columns[large ? i * (columns.size() - 1) / (count - 1) : i];
    panels.push_back({column, {column}});
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
  TableHead head{{"time", withUnit("t", scene.time_unit)}, {"panels", text}};
  if (entry.panels.empty() && columns.size() > kMaxPanels) {
    head.emplace_back("panels_note", fmt::format("{} of {} components", kMaxPanels, columns.size()));
  }
  return head;
}

}  // namespace irk
