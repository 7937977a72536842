// A claim of the paper with its protocol: what is measured, on how many cases, and what counts.
#pragma once

#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace irk::claims {

/// A claim is judged in two settings: `paper` is what the paper describes (configuration `paper`), `best` is the
/// suite's own (configurations `embedded` and `variable`).
enum class Setting { kPaper, kBest };
inline constexpr std::array kSettings = {Setting::kPaper, Setting::kBest};
std::string_view settingName(Setting setting);

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The values that confirm: those on one side of a threshold, or between two thresholds.
struct Range {
  double low = -kInfinity, high = kInfinity;
  bool low_open = false, high_open = false;  ///< whether the threshold itself does not confirm

  bool contains(double x) const { return !isBelow(x) && !isAbove(x); }
  bool isBelow(double x) const { return low_open ? x <= low : x < low; }
  bool isAbove(double x) const { return high_open ? x >= high : x > high; }
  bool isEmpty() const { return low == -kInfinity && high == kInfinity; }
  bool isTwoSided() const { return low != -kInfinity && high != kInfinity; }
};

/// `at least 1.5`, `below 1000`, `1.35 to 1.65`.
std::string rangeText(const Range& range);

/// The statistic that is computed from the values of all cases.
enum class Statistic {
  kMedian,     ///< the median of the values
  kShare,      ///< the share of the cases whose values lie in the range `clean`
  kExistence,  ///< whether there is a case whose value lies in the range `clean`
  kReport,     ///< the median, without a verdict
};

/// A part of a claim, with a number of its own. A claim has one or more parts.
struct Part {
  std::string id;        ///< "C3a"
  std::string name;      ///< in a few words, up to 40 characters
  std::string measured;  ///< the measured value of a case, in words
  std::string unit;      ///< of the statistic, as it is printed behind the number; may be empty
  Statistic statistic = Statistic::kMedian;
  Range confirmed = {};                         ///< of the statistic: median and share
  Range clean = {};                             ///< of a case: share and existence
  bool yes_or_no = false;                       ///< a case is 1 or 0, and `clean` is at least 1
  bool multibody_only = false;                  ///< only multibody systems vote
  std::array<std::string, 2> not_applied = {};  ///< by setting: why the part does not apply to it; empty if it does
};

/// A dated change of the protocol.
struct Change {
  std::string date;  ///< 2026-11-23
  std::string change, reason;
};

struct Claim {
  std::string id;       ///< "C3"
  std::string title;    ///< in a few words
  std::string words;    ///< the paper's sentence
  std::string section;  ///< of the paper
  std::vector<std::string> studies, figures;
  std::vector<Part> parts;
  std::vector<Change> history;
};

/// Where the paper says it: `section 3`, `abstract`.
std::string placeOf(const Claim& claim);

struct Protocol {
  std::vector<Claim> claims;
  std::vector<std::string> multibody;  ///< ids of the scenes that are multibody systems
};

/// The protocol of claims.toml, which is part of the program.
const Protocol& protocol();

/// Reads a file like claims.toml. Throws Misuse with `file:line` for unknown and missing keys, and for thresholds that
/// do not belong to the statistic.
Protocol parseProtocol(std::string_view toml, const std::string& file);

}  // namespace irk::claims
