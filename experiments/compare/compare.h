// Two tables of runs: what has changed, and what is noise.
#pragma once

#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "experiments/tables/table.h"

namespace irk::compare {

/// From where on two numbers are different.
struct Limits {
  double errors = 2;      ///< >= 1, a factor
  double times = 0.05;    ///< >= 0: a ratio of 1 + times, or its inverse, is not more than noise
  double alpha = 0.05;    ///< 0 < alpha < 1: of all times together, how probably noise alone makes a difference
  double counters = 0;    ///< >= 0, relative: another processor rounds otherwise
};

/// In the order in which a reader wants to know.
enum class Kind { kMissing, kOutcome, kCounter, kError, kTime };

struct Difference {
  Kind kind;
  std::string run;   ///< scene, settings, method, and what else tells the run from others of its table
  std::string what;  ///< what has changed, with both values
  double size;       ///< how much: the worst first
};

/// What can be said of times. Ratios are second over first.
struct Times {
  std::size_t compared = 0;      ///< runs with a ratio
  std::size_t few = 0;           ///< of them with fewer than five repetitions
  std::size_t not_timed = 0;     ///< successful runs without a time of a timing pass in one of the tables
  std::size_t other_processor = 0;
  std::string processors;        ///< an example of the two, where they differ
  double least = std::numeric_limits<double>::quiet_NaN(), median = least, most = least;  ///< of all ratios
};

struct Comparison {
  std::size_t first = 0, second = 0, both = 0;  ///< runs
  std::vector<Difference> differences;          ///< by kind, the worst of a kind first
  std::vector<std::string> not_compared;        ///< columns that one table has only
  Times times;
};

/// A table of runs and what its ids of environments stand for.
struct Runs {
  Table table;
  std::map<std::string, std::string> processors;  ///< by id of an environment; may be empty
};

/// Runs are matched by what was asked for (all fields of a spec that both tables have), not by their keys, which also
/// hold the program's version. Compared are outcomes, counters, errors, and the times of runs that succeeded in both.
/// Errors differ by a factor above `errors`; below round-off (1.1e-14 in double) all are the same. Times differ
/// where the interval of their ratio lies outside 1 +- times; with fewer than five repetitions, of which nothing can be
/// tested, where their minima differ by a factor above 2. Times of two processors are not compared. Throws Misuse for
/// a table without outcomes.
Comparison compareRuns(const Runs& first, const Runs& second, const Limits& limits);

}  // namespace irk::compare
