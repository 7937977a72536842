// What a comparison of two tables of runs asks and finds.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <vector>

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
inline constexpr std::size_t kKindCount = 5;
/// So many differences of each kind are kept, the largest.
inline constexpr std::size_t kWorst = 10;

struct Difference {
  Kind kind;
  std::string run;          ///< scene, settings, method, and what else tells the run from others of its table
  std::string what;         ///< the change, with both values
  double size;              ///< of the change; the largest come first
  std::uint64_t order = 0;  ///< of the run among all; decides between equal sizes
};

/// A summary of the times. Ratios are second over first; of many the median is known to 1e-4.
struct Times {
  std::size_t compared = 0;   ///< runs with a ratio
  std::size_t few = 0;        ///< of them with fewer than five repetitions
  std::size_t not_timed = 0;  ///< successful runs without a time of a timing pass in one of the tables
  std::size_t other_processor = 0;
  std::string processors;  ///< an example of the two, where they differ
  double least = std::numeric_limits<double>::quiet_NaN(), median = least, most = least;  ///< of all ratios
};

struct Comparison {
  std::size_t first = 0, second = 0, both = 0;   ///< runs
  std::array<std::size_t, kKindCount> counts{};  ///< of differences, by kind
  std::vector<Difference> differences;           ///< kWorst of each kind, by kind, the worst of a kind first
  std::vector<std::string> not_compared;         ///< columns that only one table has
  Times times;

  /// The number of all differences.
  std::size_t total() const { return std::accumulate(counts.begin(), counts.end(), std::size_t{0}); }
};

/// A table of runs and the processors of its environments.
struct Runs {
  std::filesystem::path file;
  std::map<std::string, std::string> processors;  ///< by id of an environment; may be empty
};

}  // namespace irk::compare
