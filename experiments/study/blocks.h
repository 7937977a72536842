// Which blocks of a study each of its runs is in.
#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "experiments/study/study.h"

namespace irk {

/// By key.
using BlockNames = std::unordered_map<std::uint64_t, std::string>;

/// Of all runs; `keys`: those of each series, runKeys (experiments/runner/runner.h). Empty for a study without blocks.
BlockNames blocksOf(const Study& study, const std::vector<std::vector<std::uint64_t>>& keys);

}  // namespace irk
