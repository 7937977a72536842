#include "experiments/solution/trajectory.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "experiments/solution/file.h"

namespace irk {
namespace {

// More rows than a figure has pixels only slow it down.
constexpr std::size_t kMaxRows = 2000;

struct Row {
  SolutionRow row;
  std::vector<double> values;
};

// Combines two rows: the end of the second, the smallest step, the largest error, the last switches.
Row merged(const Row& a, const Row& b) {
  Row both = b;
  both.row.h = std::fmin(a.row.h, b.row.h);
  both.row.error = std::fmax(a.row.error, b.row.error);
  both.row.newton_iterations = std::max(a.row.newton_iterations, b.row.newton_iterations);
  if (b.row.switches.empty()) both.row.switches = a.row.switches;
  return both;
}

// Keeps rows at equal distances in time, not every n-th row: most rows are small steps at switches, which show
// little.
std::vector<Row> thinned(const std::vector<Row>& rows) {
  if (rows.size() <= kMaxRows) return rows;
  const double spacing = (rows.back().row.t - rows.front().row.t) / static_cast<double>(kMaxRows);
  std::vector<Row> kept{rows.front()};
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
  const auto run = prepare(spec);
  const RunSpec whole = resolved(spec);
  std::vector<Row> rows;
  SolutionRows solution(times, whole.t_end, [&rows](const SolutionRow& row) {
    rows.push_back({row, {row.values.begin(), row.values.end()}});
  });
  Watch recording = watch;
  solution.addTo(recording);
  const RunRecord record = run->execute(recording);
  solution.finish(record);
  Table table = solutionTable(whole);
  for (Row& row : thinned(rows)) {
    row.row.values = row.values;
    table.rows.push_back(solutionCells(row.row));
  }
  writeTable(file, table);
  return record;
}

}  // namespace irk
