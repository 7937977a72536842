// Folders of results: what is computed from runs.csv, merging.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "experiments/study.h"
#include "experiments/table.h"

namespace irk {

/// orders.csv, cpu_at_error.csv, estimates.csv, energy.csv, phases.csv, scaling.csv and profile.csv, as the study asks.
/// Returns one line for every number that must not be believed; all tables are written all the same.
[[nodiscard]] std::vector<std::string> writeSummaries(const Study& study, const Table& runs,
                                                      const std::filesystem::path& folder,
                                                      std::ostream& progress);

/// All rows of the folders' runs.csv; of rows with one key a timed one wins. Throws Misuse for
/// tables of different studies or columns.
Table mergedRuns(const std::vector<std::string>& folders);

}  // namespace irk
