// Accuracy runs of a study: parallel, resumable, interruptible.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <string_view>

#include "experiments/study.h"
#include "experiments/table.h"

namespace irk {

enum class FinishedRuns { kKeep, kRunAgain };

struct RunnerOptions {
  std::filesystem::path results = "results";
  int jobs = 0;               ///< >= 0; 0 = one per processor
  int shard = 1, shards = 1;  ///< 1 <= shard <= shards: every shards-th series
  FinishedRuns finished = FinishedRuns::kKeep;
};

/// `i/n` of --shard. Throws Misuse.
void parseShard(std::string_view text, RunnerOptions& options);

/// results/<study>, and below it shard_<i>_of_<n> for a part of a study.
std::filesystem::path studyFolder(const Study& study, const RunnerOptions& options);

/// The number of threads that `jobs` stands for.
int threadCount(int jobs);

/// Makes the runs that are not in runs.csv yet and returns all of them, in the study's order
/// whatever the number of threads. After an interrupt: what there is. Progress goes to `progress`.
Table runStudy(const Study& study, const RunnerOptions& options, std::ostream& progress);

/// One row per key, the last one of each, in the order of the study; rows of no run of the study
/// are left out.
Table sortedRuns(const Table& runs, const Study& study);

}  // namespace irk
