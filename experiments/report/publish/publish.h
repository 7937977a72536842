// Published results: a folder with the answers, the figures and small tables of a full run, for readers without one.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "experiments/report/figure_list.h"

namespace irk::report {

/// Figures of a publication are in a repository: they take at most so many bytes together.
inline constexpr std::uintmax_t kMostFigureBytes = 3'000'000;

/// Writes into/README.md, into/figures/*.svg, into/tables/*.csv and into/published.csv, and removes what a former
/// publication left there. `studies` must all have results of this program's code. The same results give the same
/// files. Returns the number of doubts, each with a line on `err`: figures that cannot be drawn or are too large.
/// Throws Misuse for a folder with other files, Failure for results that cannot be published (publishedRuns).
int publish(const ReportOptions& options, const std::vector<std::string>& studies, const std::filesystem::path& into,
            std::ostream& err);

}  // namespace irk::report
