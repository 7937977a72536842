// The runs of one series that are handed out one by one, to be made at the same time.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "experiments/study/series_walk.h"

namespace irk {

/// Which run of a series is handed out next. The runs that count are those that SeriesWalk makes one after the other:
///  - kAll: all runs, the longest first.
///  - kAsymptotic: while the planner probes, each run depends on the last one. Then all planned runs are known.
///  - kTooLong: a run counts if no two runs in a row before it took too long. Before that is known, the run is handed
///    out as an uncertain one; when it turns out not to count, it is cancelled.
class OpenSeries {
 public:
  /// costs: the expected time of each run, in any unit.
  OpenSeries(Series series, std::vector<double> costs);
  OpenSeries(const OpenSeries&) = delete;
  OpenSeries& operator=(const OpenSeries&) = delete;

  /// The next run that can be made now, if there is one.
  std::optional<std::size_t> next() const;
  /// How urgent the next run is, in units of the costs: the time of all runs that can be made only after it.
  double urgency() const;
  /// The next run is being made.
  void give();
  /// Records the facts of a run that was given.
  void record(std::size_t run, const RunFacts& facts);
  /// Whether all runs that count are recorded; others may still be under way.
  bool isOver() const;
  /// Becomes true when a run that was given need not be finished; null if it always counts.
  std::shared_ptr<const std::atomic<bool>> cancelled(std::size_t run) const;

  /// The largest urgency of any run, without opening the series.
  static double largestUrgency(const Series& series, const std::vector<double>& costs);

 private:
  enum class State : char { kWaiting, kGiven, kFine, kTooLong };
  bool isCertain(std::size_t run) const;
  void plan();
  void cancel();

  Series series_;
  std::vector<double> costs_;
  double cost_left_;                // of the runs that are not given
  std::vector<std::size_t> order_;  // in which the runs are given; of planned series, as far as known
  std::size_t given_ = 0;           // of `order_`
  std::vector<State> states_;       // by run
  std::size_t under_way_ = 0;
  std::size_t limit_;                                          // runs from this one on do not count
  std::optional<SeriesWalk> walk_;                             // of planned series
  std::vector<std::shared_ptr<std::atomic<bool>>> cancelled_;  // of uncertain runs, by run
};

}  // namespace irk
