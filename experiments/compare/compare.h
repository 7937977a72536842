// Compares two tables of runs and separates changes from noise.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "experiments/tables/table.h"

namespace irk::compare {

/// The limits above which two numbers count as different.
struct Limits {
  double errors = 2;    ///< >= 1, a factor
  double times = 0.05;  ///< >= 0: ratios of times up to 1 + times, and down to its inverse, are noise
  double alpha = 0.05;  ///< 0 < alpha < 1: probability that noise alone gives a difference in any of the times
  double counters = 0;  ///< >= 0, relative: processors differ in rounding
};

/// In the order of their importance.
enum class Kind { kMissing, kOutcome, kCounter, kError, kTime };

struct Difference {
  Kind kind;
  std::string run;   ///< scene, settings, method, and what else tells the run from others of its table
  std::string what;  ///< the change, with both values
  double size;       ///< of the change; the largest come first
};

/// A summary of the times. Ratios are second over first.
struct Times {
  std::size_t compared = 0;   ///< runs with a ratio
  std::size_t few = 0;        ///< of them with fewer than five repetitions
  std::size_t not_timed = 0;  ///< successful runs without a time of a timing pass in one of the tables
  std::size_t other_processor = 0;
  std::string processors;  ///< an example of the two, where they differ
  double least = std::numeric_limits<double>::quiet_NaN(), median = least, most = least;  ///< of all ratios
};

struct Comparison {
  std::size_t first = 0, second = 0, both = 0;  ///< runs
  std::vector<Difference> differences;          ///< by kind, the worst of a kind first
  std::vector<std::string> not_compared;        ///< columns that only one table has
  Times times;
};

/// A table of runs and the processors of its environments.
struct Runs {
  Table table;
  std::map<std::string, std::string> processors;  ///< by id of an environment; may be empty
};

/// Matches runs by all fields of a spec that both tables have, not by their keys, which also contain the program's
/// version. Compares outcomes, counters, errors, and the times of runs that succeeded in both. Errors are different
/// if their ratio exceeds `errors`; errors below round-off (1.1e-14 in double) count as equal. Times are different if
/// the interval of their ratio lies outside 1 +- times; with fewer than five repetitions, which cannot be tested, if
/// their minima differ by a factor above 2. Times of different processors are not compared. Throws Misuse for a table
/// without outcomes.
Comparison compareRuns(const Runs& first, const Runs& second, const Limits& limits);

}  // namespace irk::compare
