// Progress of a study, for `irk status`.
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

/// Stale, foreign and failed runs also count as finished.
struct RunCounts {
  std::size_t planned = 0;  ///< an estimate if a StepPlanner chooses the steps
  std::size_t finished = 0;
  std::size_t failed = 0;   ///< any outcome but success
  std::size_t stale = 0;    ///< made by other code
  std::size_t foreign = 0;  ///< timed with another processor, compiler or library than those of this program
  void add(const RunCounts& other);
};

struct StudyStatus {
  /// By block, for an audit by scene, in the study's order. A run in two blocks counts in both.
  std::vector<std::pair<std::string, RunCounts>> parts;
  std::string part = "block";  ///< or `scene`
  RunCounts all;
  double seconds_left = 0;  ///< of the missing accuracy runs, on one thread, estimated from finished ones
  std::size_t guessed = 0;  ///< missing runs without a similar finished one; the overall mean is used
  std::size_t to_time = 0;  ///< finished runs that still lack timing
  double timing_seconds_left = 0;
};

/// Counts the runs of this shard of the study. Only reads.
StudyStatus statusOf(const Study& study, const RunnerOptions& options, const store::Store& store);

/// A table by block, and the remaining time.
std::string textOf(const StudyStatus& status);

}  // namespace irk
