// Rules that refuse contradictory or oversized studies.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/study/study_file.h"

namespace irk {

/// Checks the block's series, which are those from number `first` on. Throws Misuse `file:line: reason` if one has
/// variable order, where the method can change at every step, and the study wants an analysis of one method.
void refuseVariableOrder(const Study& study, const StudyKeys& block, std::size_t first);

/// The limit of runs per block, and the largest limit that its key `most_runs` can set.
inline constexpr std::int64_t kMaxRuns = 200'000, kMaxRunsAsked = 100'000'000;

/// False for keys that select methods, tolerances and steps; they are not fields of a spec.
bool isSpecKey(std::string_view key);

/// Throws Misuse with file and line for a key that a block does not have, and if one key of a block makes another
/// ineffective: `tolerances` and `steps`, `rtol` beside `tolerances`, `stages` without `families`, ...
void refuseContradictions(const StudyKeys& block);

/// Throws Misuse if a block varies an option that a peer does not use, since the peer would repeat equal runs, and if a
/// block of peers only gives one, unless that is common to all blocks.
void refuseUnusedByPeers(const StudyKeys& block, const std::vector<std::string>& methods);

/// Throws Misuse for a block with more than `most` runs, naming its lists.
void refuseTooMany(const StudyKeys& block, std::size_t methods, std::size_t runs_of_series, std::int64_t most);

}  // namespace irk
