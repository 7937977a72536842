// Chooses the constant steps for measuring an order, from the errors of the runs made so far.
#pragma once

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <vector>

namespace irk {

/// Errors of u, v, x, z; NaN if unknown.
using GroupErrors = std::array<double, 4>;

/// Plans a series of runs with constant steps h_0 > h_1 > ... It first probes: steps are halved until the slope of
/// every component has settled or its error reaches round-off, now or at the next step. Then it measures each component
/// with a geometric series of steps over a factor of four above the smallest useful step; for high orders over twelve
/// decades of the error. Steps of the probe and of other components count for a component, too. The plan depends on
/// errors only, so it is deterministic.
class StepPlanner {
 public:
  /// steps: the candidates, descending, > 0. epsilon: round-off of the runs' scalar.
  StepPlanner(std::vector<double> steps, double epsilon);

  /// Index of the next run among the candidates; nullopt when no further run is needed.
  std::optional<std::size_t> next();
  /// Whether the next run depends on the last one that `next` returned. After the probe all runs are known.
  bool isProbing() const { return probing_; }

  /// Records a successful run.
  void record(std::size_t index, const GroupErrors& errors) { runs_[index] = errors; }
  /// Records a failed run; a smaller step may succeed.
  void recordFailure(std::size_t index) { runs_[index] = kUnknown; }
  /// Ends the probe because smaller steps are useless: the run took too long, or the combination is refused.
  void endProbe() { probing_ = false; }

 private:
  struct Probe {
    double h, error;
  };

  static constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  static constexpr GroupErrors kUnknown = {kNaN, kNaN, kNaN, kNaN};

  std::optional<std::size_t> nextProbe() const;
  std::vector<Probe> probesOf(std::size_t group) const;
  std::vector<Probe> aboveRoundOff(std::size_t group) const;
  bool finished(std::size_t group) const;
  bool settled(std::size_t group) const;
  std::optional<double> smallestUseful(std::size_t group) const;
  double rangeOf(std::size_t group) const;
  void plan();
  bool measuredNear(double h, double ratio, std::size_t group) const;
  std::size_t nearest(double h) const;

  std::vector<double> steps_;
  double floor_, small_;
  bool probing_ = true, planned_ = false;
  std::map<std::size_t, GroupErrors> runs_;
  std::vector<std::size_t> plan_;  // descending; runs still to be made
};

}  // namespace irk
