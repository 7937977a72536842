// The expected times of a study's runs: from the times of an earlier table where there is one, else a guess.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "experiments/runs/run_table.h"
#include "experiments/store/rows.h"
#include "experiments/study/study.h"

namespace irk {

/// A guess of the time of each run of a series, in arbitrary units, from stages, unknowns, tolerances and steps.
std::vector<double> guessedCosts(const Series& series);
/// Their sum.
double expectedCost(const Series& series);

/// The keys of a series by its number.
using KeysOfSeries = std::function<std::vector<std::uint64_t>(std::size_t series)>;

/// The expected times of runs. Rows of any code and machine count, because only ratios matter. A run with a row takes
/// the time of that row, and if it has errors at several times, that of its runs to the earlier ones; a run without a
/// row takes the mean of its series. A series without rows takes its guess, scaled by the measured times of the other
/// series of its scene, or of all series. Without any rows the unit is that of `guessedCosts`.
class Costs {
 public:
  /// The arguments must outlive it.
  Costs(const Study& study, KeysOfSeries keys, const store::Rows& rows);

  /// The expected time of each run of a series.
  std::vector<double> of(std::size_t series) const;

 private:
  /// The sums of measured and of guessed seconds.
  struct Scale {
    double measured = 0, guessed = 0;
  };
  std::vector<double> measured(std::size_t index, const Series& series) const;

  const Study& study_;
  KeysOfSeries keys_;
  const store::Rows& rows_;
  const Table names_{{}, runColumns(), {}};
  std::map<std::string, Scale> scenes_;
  Scale all_;
};

}  // namespace irk
