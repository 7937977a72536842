// The order in which the runs of a study are made by many workers: threads or ranks.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "experiments/runner/schedule/open_series.h"
#include "experiments/study/series_walk.h"
#include "experiments/study/study.h"

namespace irk {

/// What is handed out: one run of a series.
struct Piece {
  std::size_t series = 0, run = 0;
  /// Becomes true when the run need not be finished; null if it always counts.
  std::shared_ptr<const std::atomic<bool>> cancelled = nullptr;
};

/// Hands out runs, the most urgent first (OpenSeries). Not thread-safe. Memory holds the runs of those series only that
/// are begun and not finished.
class Schedule {
 public:
  /// What the schedule asks for.
  struct Sources {
    /// The expected time of each run of a series, in any unit; 0 for a run that is stored already.
    std::function<std::vector<double>(std::size_t series)> costs;
    /// The facts of a run that is stored already; it is not handed out.
    std::function<std::optional<RunFacts>(std::size_t series, std::size_t run)> stored;
    /// Called when all runs of a series that count are recorded.
    std::function<void(std::size_t series)> ended = [](std::size_t) {};
  };
  /// Hands out the runs of these series of the study, which must outlive the schedule.
  Schedule(const Study& study, const std::vector<std::size_t>& series, Sources sources);

  /// The next run; nullopt if there is none before another one is recorded, or at all.
  std::optional<Piece> next();
  /// Records the facts of a run that was handed out. A cancelled one may have any facts.
  void record(const Piece& piece, const RunFacts& facts);
  /// Whether all runs that count are recorded.
  bool isOver() const { return open_.empty() && unopened_.empty(); }

 private:
  struct Begun {
    Begun(Series series, std::vector<double> costs) : runs(std::move(series), std::move(costs)) {}
    OpenSeries runs;
    std::optional<double> urgency;  // under which it is in `ready_`
  };
  using Ready = std::pair<double, std::size_t>;  // the negative urgency, so that the first is the next; the series
  void open();
  bool opensNext() const;
  void update(std::size_t series);

  const Study& study_;
  Sources sources_;
  std::vector<Ready> unopened_;  // the most urgent last
  std::map<std::size_t, Begun> open_;
  std::set<Ready> ready_;  // series that have a next run
};

}  // namespace irk
