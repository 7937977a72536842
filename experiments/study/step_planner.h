// Which constant steps an order is measured with: chosen from the errors of the runs made so far.
#pragma once

#include <array>
#include <limits>
#include <map>
#include <optional>
#include <vector>

namespace irk {

/// Errors of u, v, x, z; NaN where nothing is known.
using GroupErrors = std::array<double, 4>;

/// Plans a series of runs with constant steps h_0 > h_1 > ... First a probe: steps are halved until
/// every component has settled on a slope or reached round-off. Then, for every component, a
/// geometric series of steps over the last factor of four before that, for high orders over the last
/// twelve decades of the error. Deterministic: the plan
/// depends on errors only.
class StepPlanner {
 public:
  /// steps: the candidates, descending, > 0. epsilon: round-off of the runs' scalar.
  StepPlanner(std::vector<double> steps, double epsilon);

  /// Index of the next run among the candidates; nothing: enough is known.
  std::optional<std::size_t> next();

  /// A successful run.
  void record(std::size_t index, const GroupErrors& errors) { runs_[index] = errors; }
  /// A run that failed at its step; a smaller one may succeed.
  void recordFailure(std::size_t index) { runs_[index] = kUnknown; }
  /// Smaller steps are of no use: the run took too long, or the combination is refused.
  void endProbe() { probing_ = false; }

 private:
  struct Probe {
    double h, error;
  };

  static constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  static constexpr GroupErrors kUnknown = {kNaN, kNaN, kNaN, kNaN};

  std::optional<std::size_t> nextProbe() const;
  std::vector<Probe> probesOf(std::size_t group) const;
  bool finished(std::size_t group) const;
  std::optional<double> smallestUseful(std::size_t group) const;
  double rangeOf(std::size_t group) const;
  void plan();
  std::size_t nearest(double h) const;

  std::vector<double> steps_;
  double floor_;
  bool probing_ = true, planned_ = false;
  std::map<std::size_t, GroupErrors> runs_;
  std::vector<std::size_t> plan_;  // descending, runs still to be made
};

}  // namespace irk
