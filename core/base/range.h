// The range of a number as data. Validation, messages, help and tests all use the same object.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace irk {

/// Finite numbers between two bounds: `Range::from(0).below(1)` is 0 <= x < 1. NaN and infinity are never legal.
struct Range {
  double least = std::numeric_limits<double>::lowest();
  double most = std::numeric_limits<double>::max();
  bool least_excluded = false, most_excluded = false;
  bool whole = false;  ///< integers only

  static constexpr Range from(double bound) { return {.least = bound}; }
  static constexpr Range above(double bound) { return {.least = bound, .least_excluded = true}; }
  static constexpr Range integers(std::int64_t first, std::int64_t last) {
    return {.least = static_cast<double>(first), .most = static_cast<double>(last), .whole = true};
  }
  constexpr Range to(double bound) const { return with(bound, false); }
  constexpr Range below(double bound) const { return with(bound, true); }

  bool contains(double x) const {
    const bool above_least = least_excluded ? x > least : x >= least;
    const bool below_most = most_excluded ? x < most : x <= most;
    return above_least && below_most && (!whole || x == std::floor(x));
  }
  /// For messages and help: `> 0`, `0 <= x < 1`, `an integer from 1 to 100`.
  std::string text() const;

 private:
  constexpr Range with(double bound, bool excluded) const {
    Range range = *this;
    range.most = bound;
    range.most_excluded = excluded;
    return range;
  }
};

inline constexpr Range kAnyNumber{};
inline constexpr Range kPositive = Range::above(0);
inline constexpr Range kNotNegative = Range::from(0);

}  // namespace irk
