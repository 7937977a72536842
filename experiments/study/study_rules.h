// What a study cannot ask for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/study/study_file.h"

namespace irk {

/// Throws Misuse `file:line: reason` where a series of the block, those of the study from `first` on, has
/// variable order, with which every step can have another method, and the study wants an analysis of one method.
void refuseVariableOrder(const Study& study, const StudyKeys& block, std::size_t first);

/// Runs of a block unless its key `most_runs` allows more, up to kMostRunsAsked.
inline constexpr std::int64_t kMostRuns = 200'000, kMostRunsAsked = 100'000'000;

/// False for the keys that say which methods, tolerances and steps there are: not fields of a spec.
bool isSpecKey(std::string_view key);

/// Throws Misuse with file and line for keys of a block of which one would be without effect: `tolerances` and `steps`,
/// `rtol` beside `tolerances`, `stages` without `families`, ...
void refuseContradictions(const StudyKeys& block);

/// Throws Misuse where another library's integrator would repeat its runs over a list of which it takes nothing.
void refusePeersInSweeps(const StudyKeys& block, const std::vector<std::string>& methods);

/// Throws Misuse for a block of more runs than `most`, naming its lists.
void refuseTooMany(const StudyKeys& block, std::size_t methods, std::size_t runs_of_series, std::int64_t most);

}  // namespace irk
