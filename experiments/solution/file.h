// The solution over time as a file of the user: CSV or JSON lines.
#pragma once

#include <filesystem>
#include <memory>

#include "experiments/solution/rows.h"
#include "experiments/tables/table.h"

namespace irk {

/// Rows are written as they come: of a run that is interrupted, fails or is killed the file holds what was computed.
class SolutionFile {
 public:
  virtual ~SolutionFile() = default;
  /// Throws Failure if the disk is full.
  virtual void append(const SolutionRow& row) = 0;
};

/// Whether rows have error bars.
enum class RowBars { kNone, kWritten };

/// Starts a file, or replaces it, for a resolved spec. `.csv`: a table with a head (the run, the units, the diagrams)
/// and the columns t, h, error, newton_iterations, switches, components, outputs, and with bars `bar NAME` of each
/// component and output; `.jsonl`: JSON lines, the first of which is the head, with `values` and `bars`. Throws Misuse
/// for other endings, a folder that does not exist, or a file that cannot be written.
std::unique_ptr<SolutionFile> solutionFile(const std::filesystem::path& path, const RunSpec& spec,
                                           RowBars bars = RowBars::kNone);

/// Throws Misuse for a name that solutionFile refuses.
void requireSolutionPath(const std::filesystem::path& path);

/// The cells and the columns of a table of solutions.
TableRow solutionCells(const SolutionRow& row);
Table solutionTable(const RunSpec& spec, RowBars bars = RowBars::kNone);

}  // namespace irk
