// runs.csv as analyses read it: one series at a time, so that a table may be larger than the memory.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "experiments/runs/run_table.h"
#include "experiments/tables/grouped_file.h"

namespace irk {

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

}  // namespace irk
