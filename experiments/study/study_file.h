// TOML text -> lists of texts by key. The meaning of the keys is in study_reader.cpp.
//
//   title, question = "..."        orders, trajectories, estimates, energy, phases, profile, scaling, parallel = true
//   targets = [1e-4, 1e-6]         [timing]              min_time_s, repetitions, ...
//   load = "my_control.cpp"        files of the user's own, relative to the study's
//   [audit]                        runs, seed, ... instead of blocks; [audit.quick] the same, --quick only
//   [defaults]                     keys of every block   [quick]        the same, --quick only
//   [[block]]                      one sweep             [block.quick]  the same, --quick only
//
// A block has a name (letters, digits and _; block_1, block_2, ... if not given), scene, methods or families and
// stages, one of tolerances, steps, refine_most, and fields of a spec. It has up to 200 000 runs, or `most_runs`. No
// list is empty or contains an item twice.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/study/study.h"

namespace irk {

/// The value of a key: a list; a scalar is a list of one item.
struct StudyValue {
  std::vector<std::string> items;
  std::string place;  ///< `file:line`
  /// From [defaults] or [quick]: it need not have an effect on each block.
  bool common = false;
};
using StudyKeys = std::map<std::string, StudyValue, std::less<>>;

struct StudyFile {
  StudyKeys study;                ///< title, orders, ..., `timing.repetitions`
  std::vector<StudyKeys> blocks;  ///< defaults and quick variants merged in; empty for an audit only
};

/// Every block gets a key `name`; names are unique. Throws Misuse `file:line: reason`.
StudyFile parseStudyFile(std::string_view toml, const std::string& file, StudyVariant variant);

}  // namespace irk
