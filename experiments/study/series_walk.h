// Which runs a series consists of: for making runs and for counting missing ones.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/step_planner.h"
#include "experiments/study/study.h"

namespace irk {

/// The usual number of runs in a planned series.
inline constexpr std::size_t kPlannedRuns = 8;

/// The facts about a run that decide about later runs. `errors` are used by planned series only.
struct RunFacts {
  std::string outcome;
  GroupErrors errors{};
};

/// Goes through a series run by run. The outcome of each run, and in planned series its errors, determine the next
/// run.
class SeriesWalk {
 public:
  explicit SeriesWalk(const Series& series);

  /// The next run of the series; nullopt when there is none left.
  std::optional<std::size_t> next();
  /// Whether `next` may be called only after the run that it returned last has been recorded. Otherwise the runs may
  /// be recorded later and in any order.
  bool needsLast() const { return !planner_ || planner_->isProbing(); }
  /// Records the facts of a run that `next` returned.
  void record(std::size_t run, const RunFacts& facts);

  /// The second of two runs in a row that took too long: later runs are not made but recorded with its outcome. One
  /// such run is not enough: CVODE rejects 41 666 steps of medakzo at a tolerance of 1e-2, and needs 277 steps at 1e-3.
  std::optional<std::size_t> tooLong() const { return too_long_; }

 private:
  const Series& series_;
  std::optional<StepPlanner> planner_;
  std::size_t next_ = 0;
  bool last_too_long_ = false;  // of the run recorded last
  std::optional<std::size_t> too_long_;
};

/// The expected number of runs of a series, an estimate for planned ones.
std::size_t expectedRuns(const Series& series);

/// The runs of a series that are stored, and those still to be made.
struct SeriesState {
  std::vector<std::size_t> found, missing;
  std::size_t unplanned = 0;  ///< estimate of further runs that will be planned after the missing ones
};
SeriesState stateOf(const Series& series, const std::function<std::optional<RunFacts>(std::size_t run)>& facts);

/// A text that is equal for runs of about equal length. Stages are left out, because series are made in the order of
/// their stages; of planned series the step is left out, because it is not known in advance.
std::string kindOf(const RunSpec& spec, SeriesEnd end);

}  // namespace irk
