// Accuracy runs of a study: parallel, resumable, interruptible.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "experiments/runner/ranks.h"
#include "experiments/runner/shards.h"
#include "experiments/store/store.h"
#include "experiments/study/study.h"
#include "experiments/tables/table.h"

namespace irk {

struct RunnerOptions {
  std::filesystem::path results = "results";
  int jobs = 0;               ///< >= 0; 0 = one per processor
  Shard shard;
  store::StoreOptions store;
};

/// results/<study>, and below it shard_<i>_of_<n> for a part of a study.
std::filesystem::path studyFolder(const Study& study, const RunnerOptions& options);

/// The number of threads that `jobs` stands for.
int threadCount(int jobs);

/// The keys of all runs, series by series; none of series that are another shard's.
using RunKeys = std::vector<std::vector<std::uint64_t>>;
RunKeys runKeys(const Study& study, const RunnerOptions& options);
/// One after the other, each once.
std::vector<std::uint64_t> inOrder(const RunKeys& keys);

/// Makes the runs that are not in the store yet; each rank a part of them, in a store of its own. Returns the keys of all
/// runs in the study's order, whatever the number of threads and ranks. After an interrupt there may be fewer. Progress
/// goes to `progress`. Throws Failure.
std::vector<std::uint64_t> makeRuns(const Study& study, const RunnerOptions& options, store::Store& store,
                                    Ranks& ranks, std::ostream& progress);

/// The same alone, with a store of its own, in studyFolder; exports its tables and returns runs.csv.
Table runStudy(const Study& study, const RunnerOptions& options, std::ostream& progress);

}  // namespace irk
