// Makes the accuracy runs of a study: parallel, resumable, interruptible.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <string>

#include "experiments/runner/ranks.h"
#include "experiments/runner/shards.h"
#include "experiments/store/store.h"
#include "experiments/study/study.h"

namespace irk {

/// How and where the runs of a study are made.
struct RunnerOptions {
  std::filesystem::path results = "results";
  int jobs = 0;          ///< >= 0; 0 = one per processor
  int timing_cores = 0;  ///< on which runs are timed at once, >= 0; 0 = as many as do not disturb each other
  Shard shard;
  store::StoreOptions store;
};

/// results/<study>, and for a shard the folder shard_<i>_of_<n> in it.
std::filesystem::path studyFolder(const Study& study, const RunnerOptions& options);

/// The number of threads for the option `jobs`.
int threadCount(int jobs);

using store::RunKeys;
/// The keys of all runs; series of other shards are left out.
RunKeys runKeys(const Study& study, const RunnerOptions& options);

/// Makes the runs that the store lacks; each rank makes a part of them, in a store of its own. Returns the keys of
/// all runs, of which an interrupt may leave some without a row. Writes progress to `progress`. Throws Failure.
RunKeys makeRuns(const Study& study, const RunnerOptions& options, store::Store& store, Ranks& ranks,
                 std::ostream& progress);

}  // namespace irk
