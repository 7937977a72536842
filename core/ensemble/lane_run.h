// The decisions of one lane of an ensemble: step sizes, the end of its run, its result.
#pragma once

#include <memory>
#include <string>

#include "core/control/controller.h"
#include "core/control/stall_detector.h"
#include "core/estimates/defect.h"
#include "core/stages/scheme.h"
#include "irk/ensemble.h"

namespace irk {

/// The decisions of one system's run, as those of Integrator and Trajectory for the configuration `embedded`.
class LaneRun {
 public:
  /// `order`: p of the estimate's leading error h^(p+1).
  LaneRun(int order, const IntegratorOptions& options);
  LaneRun(const LaneRun&) = delete;  // its tools refer to its counters
  LaneRun& operator=(const LaneRun&) = delete;
  ~LaneRun();

  /// Begins a new run from a consistent state. Returns kSuccess, or why it ends before its first step.
  Outcome begin(std::size_t index, EnsembleMember member);
  /// The start of the run, in its system's unknowns.
  const State<double>& start() const { return start_; }

  /// Whether the run may make one more attempt; if so, `h()` is its step.
  Outcome plan(double t);
  double h() const { return size_; }
  bool filtersAgain() const { return again_; }
  std::int64_t stepsAccepted() const { return steps_; }

  /// Records that the attempt failed: in Newton's method or its matrix.
  void failed(Outcome outcome);
  /// The number of points between the stages that the attempt looks at, up to `most`, and the next of them in the
  /// sequence.
  std::int64_t looks(std::int64_t most) const {
    return looksInStep(static_cast<double>(options_.step.looks), size_, length_, most);
  }
  std::int64_t nextLook() { return look_++; }
  /// Records the attempt's estimate and its error. Returns whether the step is accepted; then `newTime` is the time at
  /// its end.
  bool decide(double estimate, double error, double round_off);
  double newTime(double t_by_lanes);
  bool isOver(double t) const { return !(t < member_.t_end); }

  /// The result of a run that has reached its end with `state`, or has failed before.
  Solution<double> success(State<double> state);
  Solution<double> failure(Outcome outcome, const State<double>& state) const;

  std::size_t index() const { return index_; }
  const EnsembleMember& member() const { return member_; }
  Counters& counters() { return counters_; }

 private:
  struct Tools;  // what needs the member's system
  double firstStep() const;
  double smallest(double t) const;

  int order_;
  const IntegratorOptions& options_;
  std::size_t index_ = 0;
  EnsembleMember member_;
  State<double> start_;
  std::string detail_;  // why the start is not consistent
  Counters counters_;
  std::unique_ptr<Tools> tools_;
  std::unique_ptr<StepController> controller_;
  StallDetector stall_;
  std::int64_t attempts_ = 0, steps_ = 0;
  std::int64_t look_ = 0;  // points looked at
  double length_ = 0, round_off_ = 0;
  double h_ = 0, size_ = 0;  // the size asked for; the size of the attempt
  LastSteps<double> last_steps_;
  bool again_ = true;
  Outcome too_small_ = Outcome::kStepTooSmall;  // the outcome of a step below the smallest size
};

}  // namespace irk
