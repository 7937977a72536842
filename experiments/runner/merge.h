// Checks and merges the results of a study's shards.
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
/// are not compared.
struct Conflict {
  std::string run;   ///< key, scene, settings, method
  std::string what;  ///< columns with both values, and the folders
};

struct MergeReport {
  std::size_t expected = 0, found = 0, missing = 0;
  std::size_t duplicate = 0;  ///< runs found in more than one folder
  std::size_t foreign = 0;    ///< runs whose times are of another timing class than most
  std::size_t not_of_study = 0;
  std::vector<Conflict> conflicts;
  std::vector<std::size_t> missing_series;  ///< series with missing runs, by their numbers in the study
};

/// `stores` are of one study; if several have a run, the first one is used.
MergeReport reportOf(const Study& study, const RunKeys& keys, const std::vector<const Store*>& stores);

/// The ids of the studies in the stored rows, each with one folder that contains it.
std::map<std::string, std::string> studiesIn(const std::vector<std::unique_ptr<Store>>& stores);

std::string textOf(const MergeReport& report);

}  // namespace irk::store
