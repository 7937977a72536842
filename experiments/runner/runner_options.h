// How and where the runs of a study are made.
#pragma once

#include <filesystem>

#include "experiments/runner/shards.h"
#include "experiments/store/store.h"

namespace irk {

struct RunnerOptions {
  std::filesystem::path results = "results";
  int jobs = 0;          ///< >= 0; 0 = one per processor
  int timing_cores = 0;  ///< on which runs are timed at once, >= 0; 0 = as many as do not disturb each other
  Shard shard;
  store::StoreOptions store;
};

}  // namespace irk
