// Makes the accuracy runs of a study: parallel, resumable, interruptible.
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
  int jobs = 0;  ///< >= 0; 0 = one per processor
  Shard shard;
  store::StoreOptions store;
};

/// results/<study>, and for a shard the folder shard_<i>_of_<n> in it.
std::filesystem::path studyFolder(const Study& study, const RunnerOptions& options);

/// The number of threads for the option `jobs`.
int threadCount(int jobs);

/// The keys of all runs, by series; empty for series of other shards.
using RunKeys = std::vector<std::vector<std::uint64_t>>;
RunKeys runKeys(const Study& study, const RunnerOptions& options);
/// All keys in order, each once.
std::vector<std::uint64_t> inOrder(const RunKeys& keys);

/// Makes the runs that the store lacks; each rank makes a part of them, in a store of its own. Returns the keys of
/// all runs in the study's order, which does not depend on the number of threads and ranks; after an interrupt there
/// may be fewer. Writes progress to `progress`. Throws Failure.
std::vector<std::uint64_t> makeRuns(const Study& study, const RunnerOptions& options, store::Store& store, Ranks& ranks,
                                    std::ostream& progress);

/// Like makeRuns, on this process only and with its own store in studyFolder; exports the tables and returns
/// runs.csv.
Table runStudy(const Study& study, const RunnerOptions& options, std::ostream& progress);

}  // namespace irk
