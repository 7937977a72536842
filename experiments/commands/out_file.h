// The file of `irk solve --out`: the solution over time.
#pragma once

#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "experiments/commands/commands.h"
#include "experiments/solution/file.h"

namespace irk {

/// The user's output file of a run. It is created with the first row, so that a refused run does not change an older
/// file.
class OutFile {
 public:
  /// For a resolved spec. Throws Misuse for a file or points that cannot be had.
  OutFile(const SolveOptions& options, const RunSpec& spec);

  void addTo(Watch& watch);
  /// After the run. With --bars, a success is followed by one more integration, that which measures error bars, and the
  /// file is written again with the bars of its rows; `watch` is that of the run.
  void finish(const RunRecord& record, const Watch& watch, std::ostream& err);

 private:
  bool asked() const { return !path_.empty(); }
  void take(const SolutionRow& row);

  const RunSpec& spec_;
  std::string path_;
  bool bars_;
  RowTimes times_;
  SolutionRows rows_;
  std::unique_ptr<SolutionFile> file_;
  std::vector<KeptRow> kept_;  // only for bars
  double t_ = 0;
};

}  // namespace irk
