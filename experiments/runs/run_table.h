// runs.csv: one row per run, failures included.
#pragma once

#include "experiments/runs/run.h"
#include "experiments/tables/table.h"

namespace irk {

/// The columns of results/<study>/runs.csv: every field of a spec has one. Units: times in s; errors are
/// relative.
std::vector<std::string> runColumns();

/// `key`: specKey of the record's spec. Timing columns are empty until the timing pass, but for cpu_s, the time of the
/// run itself. The row is of this program, of this machine and of now.
TableRow runRow(const std::string& key, const std::string& study, const RunRecord& record);

/// The columns that tell series apart: every field of a spec that is not swept (fields.h), and what is derived from
/// them. Of an older table, those that it has.
std::vector<std::string> seriesColumns(const Table& table);

/// Runs that differ in swept fields only: h, rtol, atol.
struct RunSeries {
  TableRow name;  ///< the cells of seriesColumns
  std::vector<const TableRow*> rows;
  std::string blocks = {};  ///< of all of its rows (experiments/study/blocks.h)
};
/// In the order in which they first appear. Points into the table.
std::vector<RunSeries> seriesOf(const Table& runs);

/// The spread columns of the timing pass: cpu_s is their minimum.
struct Timing {
  double minimum_s;
  double median_s;
  double spread;  ///< (max - min) / min
  std::vector<double> all_s;  ///< each repetition, in the order in which they were made
};
/// Measured here and now.
void setTiming(const Table& table, TableRow& row, const Timing& timing);
/// As if no time of the run were known.
void forgetTiming(const Table& table, TableRow& row);

/// Cells by name.
double numberAt(const Table& table, const TableRow& row, std::string_view column);
const std::string& textAt(const Table& table, const TableRow& row, std::string_view column);
bool succeededAt(const Table& table, const TableRow& row);

}  // namespace irk
