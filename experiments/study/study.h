// A study: its runs, and the analyses of their results.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/runs/run_spec.h"
#include "experiments/study/series_list.h"

namespace irk {

struct Analysis;  // analysis.h

/// The timing pass.
struct TimingOptions {
  bool wanted = false;
  double min_time_s = 0.02;   ///< > 0. Google Benchmark repeats a run until this much time is spent
  int repetitions = 3;        ///< >= 1; rounds over all runs
  double once_above_s = 0.5;  ///< > 0. Longer runs are measured only once
  double skip_above_s = 3;    ///< > 0. Still longer runs keep the time of their accuracy run
};

/// An audit: its runs are drawn at random instead of listed in blocks (experiments/study/draw.h).
struct AuditOptions {
  int runs = 12000;                      ///< > 0
  std::uint64_t seed = 1;                ///< of the draw
  int variants = 40;                     ///< > 0. Drawn settings per scene: runs with equal settings share a reference
  double time_limit = 2;                 ///< > 0, CPU seconds of each run
  std::vector<std::string> scenes = {};  ///< the scenes to draw from; empty: all of the library
};

struct Study {
  std::string id;
  std::string title;
  SeriesList series;
  std::vector<const Analysis*> analyses;  ///< analyses of the runs, in the catalogue's order
  std::vector<double> targets;            ///< errors at which costs are compared
  bool trajectories = false;              ///< write the solution over time of every run: <scene>.<method>.csv
  bool states = false;                    ///< keep the final states of all runs: states.csv
  /// Judges every success: audit.csv. The series are the drawn runs, one run each.
  std::optional<AuditOptions> audit;
  TimingOptions timing;
};

enum class StudyVariant { kFull, kQuick };

/// The specs of all runs by their keys. The study must outlive it.
class SpecsByKey {
 public:
  explicit SpecsByKey(const Study& study);
  /// nullopt if the study has no such run.
  std::optional<RunSpec> find(const std::string& key) const;

 private:
  const Study& study_;
  std::map<std::string, std::pair<std::size_t, std::size_t>> places_;  // number of the series, and of the run in it
};

/// The numbers of steps N = 2, 4, ... up to `most`, each about a tenth larger than the last: steps t_end / N. They
/// are even because the errors of methods with R(infinity) = -1 alternate.
std::vector<int> divisions(int most);

}  // namespace irk
