#include "experiments/compare/times.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "experiments/base/median.h"
#include "experiments/base/numbers.h"
#include "experiments/compare/ratio.h"
#include "experiments/tables/timing_class.h"

namespace irk::compare {
namespace {

// A rank test with fewer repetitions cannot be significant: for samples of four and four the most extreme order has
// probability 1/70, for five and five 1/252.
constexpr std::size_t kFew = 5;
// The factor by which minima of fewer repetitions, which are not tested, must differ.
constexpr double kFewFactor = 2;

std::size_t placeOf(const Table& names, std::string_view column) {
  return names.hasColumn(column) ? names.column(column) : names.columns.size();
}

}  // namespace

double factorOf(double a, double b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 1;
  if (std::isnan(a) || std::isnan(b)) return std::numeric_limits<double>::infinity();
  const double factor = std::max(a, b) / std::min(a, b);
  return std::isfinite(factor) ? factor : std::numeric_limits<double>::infinity();
}

TimeComparer::Columns::Columns(const Runs& its, const Table& names)
    : processors(its.processors),
      method(placeOf(names, "method")),
      environment(placeOf(names, "cpu_environment")),
      seconds(placeOf(names, "cpu_s")),
      runs(placeOf(names, "cpu_runs")),
      all(placeOf(names, "cpu_all")) {
  for (const auto& [key, value] : names.head) {
    if (key != "cpu") continue;
    processor = value;
    break;
  }
}

std::string TimeComparer::Columns::processorOf(const TableRow& row) const {
  if (environment < row.size()) {
    const std::string library(method < row.size() ? libraryOfMethod(row[method]) : "");
    for (const auto& id : {row[environment] + library, row[environment]}) {
      const auto found = processors.find(id);
      if (found != processors.end()) return found->second;
    }
  }
  return processor;
}

// Of the timing pass; empty if the run was not timed.
std::vector<double> TimeComparer::Columns::repetitions(const TableRow& row) const {
  std::vector<double> times;
  if (seconds >= row.size() || runs >= row.size() || !(cellNumber(row[runs]) > 0)) return times;
  if (all < row.size()) {
    std::istringstream in(row[all]);
    for (std::string word; in >> word;) times.push_back(cellNumber(word));
  }
  if (times.size() < kFew) times = {cellNumber(row[seconds])};
  std::erase_if(times, [](double t) { return !(t > 0) || std::isinf(t); });
  return times;
}

TimeComparer::TimeComparer(const Runs& first, const Runs& second, const Limits& limits, Matching& matching)
    : limits_(limits),
      matching_(matching),
      first_(first, matching.firstNames()),
      second_(second, matching.secondNames()) {}

TimeComparer::Timed TimeComparer::timedOf(const Pair& pair) const {
  Timed timed{first_.repetitions(*pair.first), second_.repetitions(*pair.second), false};
  if (timed.first.empty() || timed.second.empty()) return timed;
  timed.few = std::min(timed.first.size(), timed.second.size()) < kFew;
  if (timed.few) {
    for (auto* seconds : {&timed.first, &timed.second}) {
      *seconds = {*std::min_element(seconds->begin(), seconds->end())};
    }
  }
  return timed;
}

bool TimeComparer::isNoise(const Timed& timed, double low, double high) const {
  const double noise = timed.few ? std::max(kFewFactor, 1 + limits_.times) : 1 + limits_.times;
  return low <= noise && high >= 1 / noise;
}

void TimeComparer::note(const Pair& pair) {
  const Timed timed = timedOf(pair);
  if (timed.first.empty() || timed.second.empty()) {
    ++times_.not_timed;
    return;
  }
  const auto a = first_.processorOf(*pair.first), b = second_.processorOf(*pair.second);
  if (a != b) {
    ++times_.other_processor;
    times_.processors = fmt::format("'{}' and '{}'", a, b);
    return;
  }
  if (timed.few) ++times_.few;
  ++times_.compared;
  // With every further run the level of each test falls and its interval grows: what is noise now remains noise.
  const Ratio ratio = ratioOf(timed.first, timed.second, limits_.alpha / static_cast<double>(times_.compared));
  ratios_.push_back(ratio.ratio);
  if (!isNoise(timed, ratio.low, ratio.high)) slower_or_faster_.push_back({pair.first_at, pair.second_at});
}

Times TimeComparer::judge(const Tell& tell) {
  if (times_.compared == 0) return times_;
  const double alpha = limits_.alpha / static_cast<double>(times_.compared);
  for (const Place& place : slower_or_faster_) {
    matching_.visit(place.first, place.second, [&](const Pair& pair) {
      const Timed timed = timedOf(pair);
      const Ratio ratio = ratioOf(timed.first, timed.second, alpha);
      if (isNoise(timed, ratio.low, ratio.high)) return;
      const auto how = timed.few ? std::string("minima of fewer than five repetitions")
                                 : fmt::format("{:.3g} to {:.3g}", ratio.low, ratio.high);
      tell(pair, fmt::format("time x {:.3g} ({})", ratio.ratio, how), factorOf(1, ratio.ratio));
    });
  }
  const auto [least, most] = std::ranges::minmax(ratios_);
  times_.least = least;
  times_.most = most;
  times_.median = median(std::move(ratios_));
  return times_;
}

}  // namespace irk::compare
