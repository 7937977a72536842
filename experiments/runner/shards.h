// Splits a study into parts of about equal length, for array jobs.
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

/// Parses `i/n`. `auto/n` and, with Slurm, `auto` take i from the environment of the array job: SLURM_ARRAY_TASK_ID,
/// PBS_ARRAY_INDEX, SGE_TASK_ID. Throws Misuse.
Shard parseShard(std::string_view text);

/// The shard of each series with these costs, 1 to `shards`: the longest series first, each to the shard with the least
/// work so far.
std::vector<int> balanced(const std::vector<double>& costs, int shards);

/// The shard of each series of the study, 1 to `shards`. They are balanced by guessed costs: no job of an array needs
/// to know what others have made, and all compute the same.
std::vector<int> shardsOf(const Study& study, int shards);

/// A Slurm job script: an array of `shards` jobs that each run `run_command`, and the command that merges their
/// results.
std::string slurmScript(const Study& study, const std::string& run_command, const std::string& merge_command,
                        int shards, int jobs);

}  // namespace irk
