// Parts of a study for array jobs, of about the same length each.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/study/study.h"

namespace irk {

/// Part `index` of `count`, 1 <= index <= count.
struct Shard {
  int index = 1, count = 1;
};

/// `i/n`; `auto/n` and, of Slurm, `auto` take i from the array job's environment: SLURM_ARRAY_TASK_ID,
/// PBS_ARRAY_INDEX, SGE_TASK_ID. Throws Misuse.
Shard parseShard(std::string_view text);

/// The shard of each series, 1 to `shards`: the longest series first, each to the shard that has least so far. Depends on
/// the study only, so that all machines agree.
std::vector<int> shardOfSeries(const Study& study, int shards);

/// How long the runs of a series last, in no unit: a guess from their number, stages, unknowns and tolerances.
double expectedCost(const Series& series);

/// A job script of Slurm: an array of `shards` jobs, and the commands that join their results.
std::string slurmScript(const Study& study, const std::string& run_command, const std::string& merge_command, int shards,
                        int jobs);

}  // namespace irk
