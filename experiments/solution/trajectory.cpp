#include "experiments/solution/trajectory.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "experiments/solution/file.h"

namespace irk {
namespace {

// More rows than a figure has pixels only slow it down.
constexpr std::size_t kMaxRows = 2000;

// Combines two rows: the end of the second, the smallest step, the largest error, the last switches.
KeptRow merged(const KeptRow& a, const KeptRow& b) {
  KeptRow both = b;
  both.row.h = std::fmin(a.row.h, b.row.h);
  both.row.error = std::fmax(a.row.error, b.row.error);
  both.row.newton_iterations = std::max(a.row.newton_iterations, b.row.newton_iterations);
  if (b.row.switches.empty()) both.row.switches = a.row.switches;
  return both;
}

// Keeps rows at equal distances in time, not every n-th row: most rows are small steps at switches, which show
// little.
std::vector<KeptRow> thinned(const std::vector<KeptRow>& rows) {
  if (rows.size() <= kMaxRows) return rows;
  const double spacing = (rows.back().row.t - rows.front().row.t) / static_cast<double>(kMaxRows);
  std::vector<KeptRow> kept{rows.front()};
  bool open = false;  // the last row still absorbs the next steps
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (open) {
      kept.back() = merged(kept.back(), rows[i]);
    } else {
      kept.push_back(rows[i]);
    }
    open = kept.back().row.t < kept[kept.size() - 2].row.t + spacing;
  }
  return kept;
}

}  // namespace

std::filesystem::path trajectoryPath(const std::filesystem::path& folder, const RunSpec& spec) {
  std::string name = spec.scene;
  for (const auto& [key, value] : spec.settings) name += '_' + key + '_' + value;
  std::string method = spec.method;  // of a tableau file, its path
  std::replace(method.begin(), method.end(), '/', '_');
  return folder / (name + '.' + method + ".csv");
}

RunRecord executeWithTrajectory(const RunSpec& spec, const Watch& watch, const std::filesystem::path& file,
                                const RowTimes& times) {
  std::vector<KeptRow> rows;
  const RunRecord record = executeWithRows(spec, watch, times, rows);
  Table table = solutionTable(resolved(spec));
  for (const KeptRow& row : thinned(rows)) table.rows.push_back(solutionCells(row.view()));
  writeTable(file, table);
  return record;
}

}  // namespace irk
