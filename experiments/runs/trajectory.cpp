#include "experiments/runs/trajectory.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "experiments/base/numbers.h"
#include "experiments/runs/panels.h"
#include "experiments/tables/environment.h"
#include "experiments/tables/table.h"

namespace irk {
namespace {

// More rows than a figure has pixels only slow it down.
constexpr std::size_t kMaxRows = 2000;

// The columns before the components. A row summarizes the steps since the previous row.
constexpr std::string_view kStepColumns[] = {"t", "h", "error", "newton_iterations", "switches"};

struct Row {
  double t, h, error;
  int newton_iterations, switches;
  std::vector<double> values;
};

// Combines two rows: the end of the second, the smallest step and the largest error.
Row merged(const Row& a, const Row& b) {
  return {b.t,
          std::fmin(a.h, b.h),
          std::fmax(a.error, b.error),
          std::max(a.newton_iterations, b.newton_iterations),
          a.switches + b.switches,
          b.values};
}

// Keeps rows at equal distances in time, not every n-th row: most rows are small steps at switches, which show
// little.
std::vector<Row> thinned(const std::vector<Row>& rows) {
  if (rows.size() <= kMaxRows) return rows;
  const double spacing = (rows.back().t - rows.front().t) / static_cast<double>(kMaxRows);
  std::vector<Row> kept{rows.front()};
  bool open = false;  // the last row still absorbs the next steps
  for (std::size_t i = 1; i < rows.size(); ++i) {
    if (open) {
      kept.back() = merged(kept.back(), rows[i]);
    } else {
      kept.push_back(rows[i]);
    }
    open = kept.back().t < kept[kept.size() - 2].t + spacing;
  }
  return kept;
}

TableRow cells(const Row& row) {
  TableRow cells{numberText(row.t), numberText(row.h), numberText(row.error), std::to_string(row.newton_iterations),
                 std::to_string(row.switches)};
  for (const double value : row.values) cells.push_back(numberText(value));
  return cells;
}

}  // namespace

std::filesystem::path trajectoryPath(const std::filesystem::path& folder, const RunSpec& spec) {
  std::string name = spec.scene;
  for (const auto& [key, value] : spec.settings) name += '_' + key + '_' + value;
  std::string method = spec.method;  // of a tableau file, its path
  std::replace(method.begin(), method.end(), '/', '_');
  return folder / (name + '.' + method + ".csv");
}

RunRecord executeWithTrajectory(const RunSpec& spec, const Watch& watch, const std::filesystem::path& file) {
  const auto run = prepare(spec);
  std::vector<Row> rows;
  int switches = 0;
  Watch recording = watch;
  recording.accepted = [&](const AcceptedStep& step) {
    rows.push_back({step.t,
                    step.h,
                    step.error,
                    step.newton_iterations,
                    std::exchange(switches, 0),
                    {step.values.begin(), step.values.end()}});
  };
  recording.switched = [&](double, const std::string&) { ++switches; };
  const RunRecord record = run->execute(recording);
  Table table{
      environmentHead("trajectory of " + spec.scene, 1), {std::begin(kStepColumns), std::end(kStepColumns)}, {}};
  for (auto& line : panelHead(findScene(spec.scene), makeScene<double>(spec.scene, settingsAtStep(spec)))) {
    table.head.push_back(std::move(line));
  }
  for (const auto& name : run->columns()) table.columns.push_back(name);
  for (const auto& row : thinned(rows)) table.rows.push_back(cells(row));
  writeTable(file, table);
  return record;
}

}  // namespace irk
