// What is computed from runs.csv.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "experiments/study/study.h"
#include "experiments/tables/table.h"

namespace irk {

/// Why a runs.csv has no times: they are of several processors. Empty where it has them.
std::string refusedTimes(const TableHead& head);
/// The same of a file, of which only the head is read.
std::string refusedTimes(const std::filesystem::path& runs);

/// The files of the study's analyses (experiments/study/analysis.h).
/// Where the times are of several processors (store::kTimesRefused) there is no profile, and costs have no times.
/// Returns one line for every number that must not be believed; all tables are written all the same.
[[nodiscard]] std::vector<std::string> writeSummaries(const Study& study, const Table& runs,
                                                      const std::filesystem::path& folder,
                                                      std::ostream& progress);

}  // namespace irk
