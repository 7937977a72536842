// runs.csv as analyses read it, one series at a time, so that a table may be larger than the memory; and as they repeat
// its runs.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "experiments/runs/run_table.h"
#include "experiments/tables/grouped_file.h"

namespace irk {

class Progress;  // experiments/base/progress.h
struct Study;

/// A series (seriesOf) with its rows.
struct HeldSeries {
  std::vector<TableRow> rows;
  RunSeries series;  ///< points to `rows`

  HeldSeries() = default;
  HeldSeries(HeldSeries&&) = default;
  HeldSeries& operator=(HeldSeries&&) = default;
};

/// The series that seriesOf finds in a runs.csv: its groups by seriesColumns.
class RunFile : public GroupedFile {
 public:
  /// Reads the file once.
  explicit RunFile(const std::filesystem::path& file);

  /// Series i.
  HeldSeries operator[](std::size_t i) const;
  void forEachSeries(const std::function<void(const RunSeries&)>& take) const;
};

/// `series`: that of the run; `row`: the run's row in runs.csv.
using RepeatRun = std::function<void(const RunSeries& series, const TableRow& row, const RunSpec& spec)>;

/// Calls `repeat` for every successful run of the study that this suite's integrator made, one after another, until an
/// interrupt. `progress` is told of all runs, unless it is nullptr.
void repeatRuns(const Study& study, const RunFile& runs, Progress* progress, const RepeatRun& repeat);

}  // namespace irk
