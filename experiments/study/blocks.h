// Which blocks of a study contain each run.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "experiments/study/study.h"

namespace irk {

/// Block names by the key of a run.
using BlockNames = std::unordered_map<std::uint64_t, std::string>;

/// The block names of all runs; `keys` are those of each series, runKeys (experiments/runner/runner.h). Empty for a
/// study without blocks.
BlockNames blocksOf(const Study& study, const std::vector<std::vector<std::uint64_t>>& keys);

}  // namespace irk
