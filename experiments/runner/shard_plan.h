// Which shard makes which series: decided once, so that all jobs of an array agree, whenever they start.
#pragma once

#include <cstdint>
#include <vector>

#include "experiments/runner/runner_options.h"
#include "experiments/study/study.h"

namespace irk {

/// The keys of the runs of a series.
std::vector<std::uint64_t> keysOf(const Series& series);

/// The shard of each series, 1 to options.shard.count. It is read from results/<study>/shards_of_<n> if that file was
/// written for these series; otherwise it is balanced by the times in results/<study> and by guesses (Costs).
/// Throws Failure.
std::vector<int> shardsOf(const Study& study, const RunnerOptions& options);

/// Writes results/<study>/shards_of_<n>, unless it was written for these series.
void keepShards(const Study& study, const RunnerOptions& options);

}  // namespace irk
