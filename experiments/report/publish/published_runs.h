// Which runs published results come from, and whether they may be published.
#pragma once

#include <string>
#include <vector>

#include "experiments/report/figure_list.h"
#include "experiments/tables/table.h"

namespace irk::report {

/// The runs of each study, from the head of its runs.csv.
struct PublishedRuns {
  /// Columns: study, runs, code, version, commit, date (the first and the last run, in UTC), compiler, flags,
  /// libraries, cpu. The head has what all studies share: the program's version, code and commit, and the last date.
  Table table;
  std::vector<std::string> doubts;  ///< about times, a sentence each
};

/// Throws Failure with one line that names every study that is missing, was made by code with other numbers than this
/// program's, or lacks times because they come from several processors.
PublishedRuns publishedRuns(const ReportOptions& options, const std::vector<std::string>& studies);

}  // namespace irk::report
