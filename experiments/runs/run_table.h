// runs.csv: one row per run, failures included.
#pragma once

#include "experiments/runs/run.h"
#include "experiments/tables/table.h"

namespace irk {

/// The columns of results/<study>/runs.csv: every field of a spec and the results. Times are in s, errors are
/// relative.
std::vector<std::string> runColumns();

/// `key` is the specKey of the record's spec. Timing columns stay empty until the timing pass, except cpu_s, the time
/// of the integration itself. Code, environment and date are those of this program, this machine and now.
TableRow runRow(const std::string& key, const std::string& study, const RunRecord& record);

/// The columns that distinguish series: every field of a spec that is not swept (fields.h), and the columns derived
/// from them. For an older table, those that it has.
std::vector<std::string> seriesColumns(const Table& table);

/// Runs that differ in swept fields only: h, rtol, atol.
struct RunSeries {
  TableRow name;  ///< the cells of seriesColumns
  std::vector<const TableRow*> rows;
  std::string blocks = {};  ///< of all of its rows (block_names.h)
};
/// In the order of their first rows. The results point into `runs`.
std::vector<RunSeries> seriesOf(const Table& runs);

/// The result of the timing pass, of whole calls (PreparedRun::wholeCall); the column cpu_s is the minimum.
struct Timing {
  double minimum_s;
  double median_s;
  double spread;                                              ///< (max - min) / min
  std::vector<double> all_s;                                  ///< each repetition, in the order in which they were made
  double setup_s = std::numeric_limits<double>::quiet_NaN();  ///< the part of the set-up, minimum; NaN if not measured
};
/// Writes times that were measured here and now.
void setTiming(const Table& table, TableRow& row, const Timing& timing);
/// Says at the end of `detail` why the run could not be timed now. Times that it has stay; the next setTiming takes the
/// text away.
void setNotTimed(const Table& table, TableRow& row, const std::string& cause);
/// Resets the timing columns, as if the run had not been timed.
void forgetTiming(const Table& table, TableRow& row);

/// Cells by the name of their column.
double numberAt(const Table& table, const TableRow& row, std::string_view column);
const std::string& textAt(const Table& table, const TableRow& row, std::string_view column);
bool succeededAt(const Table& table, const TableRow& row);
/// Whether all steps of the run had one size, so that it had no tolerance.
bool hasFixedStepsAt(const Table& table, const TableRow& row);
/// Whether the run's error is below kMeasurable accuracies of its computed reference and therefore NaN.
bool notMeasurableAt(const Table& table, const TableRow& row);
/// A bound of the run's error: its largest error at its reference times; if that is unknown, its error at the end; if
/// that is not measurable, the bound below which it lies. NaN if none is known.
double errorBoundAt(const Table& table, const TableRow& row);

/// The largest change of all invariants, each divided by the magnitude of its value at the start. A value below 1e-9 of
/// the change counts as 0, as the energy of a beam that is straight but for round-off, and does not divide. NaN without
/// invariants.
double largestChange(const std::vector<InvariantChange>& invariants);

}  // namespace irk
