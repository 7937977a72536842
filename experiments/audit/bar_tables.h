// The two tables of an audit beside its counts: what the error bars are worth (thresholds.h), and how often the word of
// a solver is wrong without them.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "experiments/tables/table.h"

namespace irk::audit {

/// audit_error_bar.csv of an audit.csv: one row per group of the runs with an error bar, over all, by configuration,
/// collection, family and scene. Columns:
///   successes, judged, covered, coverage   judged: with a known bar and a known reference
///   unknown                                successes whose bar is unknown
///   sharp_runs, sharp_10, sharp_median, sharp_90, sharp_share   bar / true error: its 10th and 90th percentile, and
///                                          the part between kSharpFrom and kSharpTo
///   near_runs, false_alarms, false_share   runs to the end with an error below kRightTolerances
///   cost_runs, cost_median                 CPU time of the integrations that measure / that of the run
Table errorBarTable(const std::filesystem::path& audit);

/// audit_own_word.csv: one row per integrator, ours by configuration and those of other libraries, over all scenes and
/// by collection. `successes` are what the solver itself calls one: runs that only the error bar ended as inaccurate
/// count. Of the `judged` ones, with a known reference, `above_100` and `above_1000` have an error in u, v or x above
/// so many tolerances and 1e-9, as in the audit's bar.
Table ownWordTable(const std::filesystem::path& audit);

/// Columns of a table, with what stands above them in lines for the terminal.
using Titles = std::vector<std::pair<std::string, std::string>>;
/// The rows whose column `by`, the first one, is in `kinds`, below a line with `head` and the titles.
std::string linesOf(const Table& table, const std::string& head, const std::vector<std::string>& kinds,
                    const Titles& titles);
/// Lines for the terminal: all runs, configurations, collections, and what is asked.
std::string errorBarText(const Table& bars);
std::string ownWordText(const Table& words);

}  // namespace irk::audit
