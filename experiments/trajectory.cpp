#include "experiments/trajectory.h"

#include <algorithm>

#include "experiments/environment.h"
#include "experiments/numbers.h"
#include "experiments/table.h"

namespace irk {
namespace {

// More rows than a figure has pixels only make it slow.
constexpr std::size_t kMostRows = 2000;

// Keeps rows by their time, not their number: chattering takes most steps and shows least.
void thin(std::vector<TableRow>& rows) {
  if (rows.size() <= kMostRows) return;
  const auto time = [](const TableRow& row) { return std::stod(row.front()); };
  const double first = time(rows.front());
  const double spacing = (time(rows.back()) - first) / static_cast<double>(kMostRows);
  std::vector<TableRow> kept;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    if (kept.empty() || time(rows[i]) >= time(kept.back()) + spacing) {
      kept.push_back(std::move(rows[i]));
    }
  }
  kept.push_back(std::move(rows.back()));
  rows = std::move(kept);
}

}  // namespace

std::filesystem::path trajectoryPath(const std::filesystem::path& folder, const RunSpec& spec) {
  std::string name = spec.scene;
  for (const auto& [key, value] : spec.settings) name += '_' + key + '_' + value;
  return folder / (name + ".csv");
}

RunRecord executeWithTrajectory(const RunSpec& spec, const Watch& watch,
                                const std::filesystem::path& file) {
  const auto run = prepare(spec);
  Table table{environmentHead("trajectory of " + spec.scene, 1), {"t"}, {}};
  for (const auto& name : run->columns()) table.columns.push_back(name);
  Watch recording = watch;
  recording.accepted = [&](double t, std::span<const double> values) {
    TableRow row{numberText(t)};
    for (const double value : values) row.push_back(numberText(value));
    table.rows.push_back(std::move(row));
  };
  const RunRecord record = run->execute(recording);
  thin(table.rows);
  writeTable(file, table);
  return record;
}

}  // namespace irk
