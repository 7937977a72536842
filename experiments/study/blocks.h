// The names of a study's blocks, by which figures and claims choose runs.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "experiments/study/study.h"

namespace irk {

/// The last column of runs.csv and of tables made from it: the blocks that a run or a series is in, separated by blanks.
/// It is written when tables are exported and is no part of a run's key: a block can get another name.
inline constexpr std::string_view kBlockColumn = "block";

/// By key.
using BlockNames = std::unordered_map<std::uint64_t, std::string>;

/// Of all runs; `keys`: those of each series, runKeys (experiments/runner/runner.h). Empty for a study without blocks.
BlockNames blocksOf(const Study& study, const std::vector<std::vector<std::uint64_t>>& keys);

/// Whether `name` is one of the names.
bool hasBlock(std::string_view names, std::string_view name);
/// Adds those of `more` that are not there yet.
void addBlocks(std::string& names, std::string_view more);

}  // namespace irk
