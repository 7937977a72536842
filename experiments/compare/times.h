// The times of runs of two tables.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "experiments/compare/comparison.h"
#include "experiments/compare/matching.h"

namespace irk::compare {

/// The larger number divided by the smaller: 1 for equal numbers, infinity if one of them is 0 or unknown.
double factorOf(double a, double b);

/// Compares the times of pairs of successful runs. Keeps references to its arguments.
class TimeComparer {
 public:
  /// Of a run whose times differ: the change in words, and its factor.
  using Tell = std::function<void(const Pair& pair, std::string what, double size)>;

  TimeComparer(const Runs& first, const Runs& second, const Limits& limits, Matching& matching);

  void note(const Pair& pair);
  /// Call it after the last pair. alpha is the level of all tests together: each of m runs is tested with alpha / m.
  Times judge(const Tell& tell);

 private:
  /// The columns of one table.
  struct Columns {
    Columns(const Runs& runs, const Table& names);
    std::string processorOf(const TableRow& row) const;
    std::vector<double> repetitions(const TableRow& row) const;

    const std::map<std::string, std::string>& processors;
    std::string processor = "unknown";  ///< of the whole table
    std::size_t method, environment, seconds, runs, all;
  };
  /// The repetitions of a run in both tables, or only their minima if one table has too few.
  struct Timed {
    std::vector<double> first, second;
    bool few;
  };
  struct Place {
    std::uint64_t first, second;
  };
  Timed timedOf(const Pair& pair) const;
  bool isNoise(const Timed& timed, double low, double high) const;

  const Limits& limits_;
  Matching& matching_;
  Columns first_, second_;
  Times times_;
  std::vector<double> ratios_;           // of all that are compared
  std::vector<Place> slower_or_faster_;  // that may be more than noise
};

}  // namespace irk::compare
