// Writes all tables that are computed from runs.csv.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "experiments/analyses/run_file.h"
#include "experiments/study/study.h"

namespace irk {

/// The reason why a runs.csv has no times: they come from several processors. Empty if it has times.
std::string refusedTimes(const TableHead& head);
/// The same for a file; only its head is read.
std::string refusedTimes(const std::filesystem::path& runs);

/// Why the times of a runs.csv are doubtful: the speed of a processor changed while they were measured, or hosts with
/// the same processor differ in speed (store::calibrationDoubts). Empty if they are not.
std::string timesDrift(const std::filesystem::path& runs);

/// On how many cores at once the times of a runs.csv were measured, by host: `2 on HOST`. Empty if that is not known.
std::string timingCores(const std::filesystem::path& runs);
/// Prints the doubts about times, if there are any.
void tellDrift(const std::string& study, const std::filesystem::path& runs, std::ostream& out);
/// The same for many studies in one line, which does not get lost between theirs.
void tellDrifts(const std::vector<std::filesystem::path>& folders, std::ostream& out);

/// Writes the tables of the study's analyses (experiments/study/analysis.h). If times come from several processors
/// (refusedTimes), it writes no profile, and costs without times.
void writeSummaries(const Study& study, const RunFile& runs, const std::filesystem::path& folder,
                    std::ostream& progress);

}  // namespace irk
