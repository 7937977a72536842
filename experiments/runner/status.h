// How far a study is: irk status.
#pragma once

#include <cstddef>
#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

#include "experiments/runner/runner.h"
#include "experiments/store/store.h"
#include "experiments/study/study.h"

namespace irk {

/// Stale, foreign and failed runs are finished, too.
struct RunCounts {
  std::size_t planned = 0;   ///< where a StepPlanner chooses the steps: as far as is known
  std::size_t finished = 0;
  std::size_t failed = 0;    ///< any outcome but success
  std::size_t stale = 0;     ///< made by other code
  std::size_t foreign = 0;   ///< made on another processor
  void add(const RunCounts& other);
};

struct StudyStatus {
  /// By block, of an audit by scene; in the study's order. A run of two blocks counts in both.
  std::vector<std::pair<std::string, RunCounts>> parts;
  std::string part = "block";  ///< or `scene`
  RunCounts all;
  double seconds_left = 0;          ///< of the missing accuracy runs, on one thread, from the times of finished ones
  std::size_t guessed = 0;          ///< missing runs without a finished one alike: counted as the mean of all finished ones
  std::size_t to_time = 0;          ///< finished runs that the timing pass has still to measure
  double timing_seconds_left = 0;
};

/// Of the runs of this shard of the study. Reads only.
StudyStatus statusOf(const Study& study, const RunnerOptions& options, const store::Store& store);

/// A table by block, and the time still needed.
std::string textOf(const StudyStatus& status);

}  // namespace irk
