// The solution over time, row by row, while a run goes on.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "experiments/runs/run.h"

namespace irk {

/// The times of rows. Each located switch has two more rows, before and after it.
struct RowTimes {
  int points = 0;     ///< 0, or 2 and more: equally spaced from the start to t_end, both included
  bool steps = true;  ///< the ends of all accepted steps; then `points` inside steps only where the method knows them
};

struct SolutionRow {
  double t;
  double h, error;        ///< of the step that ends at t or contains it, see AcceptedStep
  int newton_iterations;  ///< likewise
  std::string switches;   ///< that lead to this row's state, or are in its step: names with "; " between; mostly empty
  std::span<const double> values;     ///< see AcceptedStep
  std::span<const double> bars = {};  ///< the measured errors of the values, NaN: unknown; empty: not asked for
};

/// A row with values of its own.
struct KeptRow {
  explicit KeptRow(const SolutionRow& r)
      : row(r), values(r.values.begin(), r.values.end()), bars(r.bars.begin(), r.bars.end()) {}
  /// Valid as long as this object.
  SolutionRow view() const {
    SolutionRow view = row;
    view.values = values;
    view.bars = bars;
    return view;
  }

  SolutionRow row;  ///< its spans are not valid
  std::vector<double> values, bars;
};

/// The rows with their bars: the distance, value by value, from the row of `strict` at the same time. Both are those of
/// the same equally spaced points. Rows at switches, whose times differ, and rows beyond the end of `strict` have
/// unknown bars.
std::vector<KeptRow> barred(std::vector<KeptRow> rows, const std::vector<KeptRow>& strict);

/// Listens to a run and makes the rows. One object per run; it must outlive the run.
class SolutionRows {
 public:
  /// `take` gets each row in the order of time, while the run goes on.
  SolutionRows(RowTimes times, double t_end, std::function<void(const SolutionRow&)> take);

  /// Adds itself to the watch's callbacks. If a method gives the solution at the ends of its steps only, `points`
  /// without `steps` are Misuse, thrown in the first step.
  void addTo(Watch& watch);
  /// After the run: the last accepted state, of a failed run or if the last step ended next to t_end.
  void finish(const RunRecord& record);

 private:
  void accepted(const AcceptedStep& step);
  void switched(double t, const std::string& name, std::span<const double> values);
  double time(int i) const;
  void fill(const AcceptedStep& step);
  void show();

  RowTimes times_;
  double t_end_, start_ = 0;
  std::function<void(const SolutionRow&)> take_;
  int next_ = 0;  // of the points
  bool started_ = false;
  SolutionRow last_{};  // the end of the last step, or after its switches
  bool shown_ = false;  // whether last_ has been given as a row
  std::vector<double> values_;
  std::string inside_;  // switches inside the next step
};

/// Runs the spec and keeps its rows at `times`. Throws Misuse as `prepare` and SolutionRows.
RunRecord executeWithRows(const RunSpec& spec, const Watch& watch, const RowTimes& times, std::vector<KeptRow>& rows);

}  // namespace irk
