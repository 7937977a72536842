// A study: which runs, and what to do with them afterwards.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/runs/run_spec.h"
#include "experiments/study/series_runs.h"

namespace irk {

struct Analysis;  // analysis.h

/// When the runs of a series that come later need not be made.
enum class SeriesEnd {
  kAll,         ///< every run is made
  kAsymptotic,  ///< a StepPlanner chooses among them, to measure orders
  kTooLong,     ///< after one that ran out of steps or time, the harder ones are recorded as such
};

/// Runs of one method on one scene, from the easiest to the hardest: made in this order.
struct Series {
  SeriesRuns runs;
  SeriesEnd end = SeriesEnd::kAll;
  std::string block = {};  ///< the name of its block; empty for the runs of an audit
};

/// The serial timing pass.
struct TimingOptions {
  bool wanted = false;
  double min_time_s = 0.02;   ///< > 0. Google Benchmark repeats a run until this much time is spent
  int repetitions = 3;        ///< >= 1; rounds over all runs
  double once_above_s = 0.5;  ///< > 0. Longer runs are repeated once only, ...
  double skip_above_s = 3;    ///< > 0. ... and still longer ones keep the accuracy run's time
};

/// An audit: runs drawn at random instead of blocks (experiments/study/draw.h).
struct AuditOptions {
  int runs = 12000;        ///< > 0
  std::uint64_t seed = 1;  ///< of the draw
  int variants = 40;       ///< > 0. Drawn settings per scene: runs share their references
  double time_limit = 2;   ///< > 0, CPU seconds of each run
};

struct Study {
  std::string id;
  std::string title;
  std::vector<Series> series;
  std::vector<const Analysis*> analyses;  ///< what is computed from the runs, in the catalogue's order
  std::vector<double> targets;            ///< errors at which costs are compared
  bool trajectories = false;              ///< write the solution over time of every run: <scene>.<method>.csv
  bool states = false;                    ///< keep the final states of all runs: states.csv
  /// Judge every success: audit.csv. The series are the drawn runs, one each.
  std::optional<AuditOptions> audit;
  TimingOptions timing;
};

enum class StudyVariant { kFull, kQuick };

/// The specs of all runs by their keys; the study must outlive it.
class SpecsByKey {
 public:
  explicit SpecsByKey(const Study& study);
  /// Nothing where the study has no such run.
  std::optional<RunSpec> find(const std::string& key) const;

 private:
  const Study& study_;
  std::map<std::string, std::pair<std::size_t, std::size_t>> places_;  // number of the series, and in it
};

/// N = 2, 4, ... growing by about a tenth, up to `most`: steps t_end / N. Even, because errors of
/// methods with R(infinity) = -1 alternate.
std::vector<int> divisions(int most);

}  // namespace irk
