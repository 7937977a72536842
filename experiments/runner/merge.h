// What the folders of shards hold together.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "experiments/runner/runner.h"
#include "experiments/store/store.h"
#include "experiments/study/study.h"

namespace irk::store {

/// Rows of one key and one code that disagree in outcome, counters or errors: the run is not deterministic. Timeouts
/// do not count.
struct Conflict {
  std::string run;   ///< key, scene, settings, method
  std::string what;  ///< columns with both values, and the folders
};

struct MergeReport {
  std::size_t expected = 0, found = 0, missing = 0;
  std::size_t duplicate = 0;  ///< found in more than one folder
  std::size_t foreign = 0;    ///< found, but made on another processor than most
  std::size_t not_of_study = 0;
  std::vector<Conflict> conflicts;
  std::vector<std::size_t> missing_series;  ///< their numbers in the study
};

/// `stores`: of one study; where several have a run, the first is looked at.
MergeReport reportOf(const Study& study, const RunKeys& keys, const std::vector<const Store*>& stores);

/// The ids of the studies that the rows name, with one folder of each.
std::map<std::string, std::string> studiesIn(const std::vector<std::unique_ptr<Store>>& stores);

std::string textOf(const MergeReport& report);

}  // namespace irk::store
