// Which runs of a series there have to be: for making them, and for counting what is missing.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/step_planner.h"
#include "experiments/study/study.h"

namespace irk {

/// A planned series has usually so many runs.
inline constexpr std::size_t kPlannedRuns = 11;

/// What a run says about the runs after it. `errors` matter in planned series only.
struct RunFacts {
  std::string outcome;
  GroupErrors errors{};
};

/// Goes through a series run by run. What a run was decides which one is next: its outcome, and where a StepPlanner
/// chooses, its errors.
class SeriesWalk {
 public:
  explicit SeriesWalk(const Series& series);

  /// The next run of the series; nothing: there are all.
  std::optional<std::size_t> next();
  /// Of the run that `next` gave.
  void record(std::size_t run, const RunFacts& facts);

  /// A run that took too long: the runs after it are not made but recorded as it was.
  std::optional<std::size_t> tooLong() const { return too_long_; }

 private:
  const Series& series_;
  std::optional<StepPlanner> planner_;
  std::size_t next_ = 0;
  std::optional<std::size_t> too_long_;
};

/// How many runs a series will have, as far as is known before they are made.
std::size_t expectedRuns(const Series& series);

/// What of a series is there, and what is still to be made.
struct SeriesState {
  std::vector<std::size_t> found, missing;
  std::size_t unplanned = 0;  ///< further runs to come, which only the missing ones will decide: an estimate
};
SeriesState stateOf(const Series& series, const std::function<std::optional<RunFacts>(std::size_t run)>& facts);

/// What tells how long a run lasts, but for its number of stages: series come in their order. Of planned series the
/// steps to come are not known.
std::string kindOf(const RunSpec& spec, SeriesEnd end);

}  // namespace irk
