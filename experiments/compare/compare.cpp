#include "experiments/compare/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "experiments/base/numbers.h"
#include "experiments/compare/matching.h"
#include "experiments/compare/ratio.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/run_table.h"
#include "irk/misuse.h"
#include "irk/statistics.h"

namespace irk::compare {
namespace {

constexpr std::string_view kErrors[] = {"error",   "error_u", "error_v",         "error_x",
                                        "error_z", "drift",   "invariant_change"};
// Errors below this many units of round-off of their scalar are not compared: 1.1e-14 in double precision.
constexpr double kRoundOff = 50;
// A rank test with fewer repetitions cannot be significant: for samples of four and four the most extreme order has
// probability 1/70, for five and five 1/252.
constexpr std::size_t kFew = 5;
// The factor by which minima of fewer repetitions, which are not tested, must differ.
constexpr double kFewFactor = 2;

// The larger number divided by the smaller: 1 for equal numbers, infinity if one of them is 0 or unknown.
double factorOf(double a, double b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 1;
  if (std::isnan(a) || std::isnan(b)) return std::numeric_limits<double>::infinity();
  const double factor = std::max(a, b) / std::min(a, b);
  return std::isfinite(factor) ? factor : std::numeric_limits<double>::infinity();
}

/// Compares two tables row by row.
class Comparer {
 public:
  Comparer(const Runs& first, const Runs& second, const Limits& limits)
      : first_(first), second_(second), limits_(limits), matching_(first.table, second.table) {
    for (const auto* runs : {&first, &second}) {
      if (!runs->table.hasColumn("outcome")) throw Misuse("no table of runs: it has no column 'outcome'");
    }
    chooseColumns();
    result_.first = first.table.rows.size();
    result_.second = second.table.rows.size();
  }

  Comparison run() {
    for (const auto& pair : matching_.pairs()) {
      if (!pair.first || !pair.second) {
        add(Kind::kMissing, pair, pair.first ? "only in the first" : "only in the second", 1);
        continue;
      }
      ++result_.both;
      if (!compareOutcome(pair)) continue;
      compareCounters(pair);
      compareErrors(pair);
      noteTimes(pair);
    }
    judgeTimes();
    std::stable_sort(
        result_.differences.begin(), result_.differences.end(),
        [](const Difference& a, const Difference& b) { return a.kind != b.kind ? a.kind < b.kind : a.size > b.size; });
    return std::move(result_);
  }

 private:
  /// The repetitions of a run in both tables, or only their minima if one table has too few.
  struct Timed {
    Pair pair;
    std::vector<double> first, second;
    bool few;
  };

  void chooseColumns() {
    const auto choose = [this](std::string_view name, std::vector<std::string>& chosen) {
      const bool a = first_.table.hasColumn(name), b = second_.table.hasColumn(name);
      if (a && b) chosen.emplace_back(name);
      if (a != b) {
        result_.not_compared.push_back(fmt::format("{} (only in the {})", name, a ? "first" : "second"));
      }
    };
    Counters{}.forEach([&](const char* name, std::int64_t) { choose(name, counters_); });
    for (const auto name : kErrors) choose(name, errors_);
    std::vector<std::string> ignored;
    for (const auto& field : specFields()) choose(field.name, ignored);
  }

  void add(Kind kind, const Pair& pair, std::string what, double size) {
    result_.differences.push_back({kind, matching_.nameOf(pair), std::move(what), size});
  }
  const std::string& text(const Pair& pair, std::string_view column, bool second) const {
    return second ? textAt(second_.table, *pair.second, column) : textAt(first_.table, *pair.first, column);
  }

  // Returns false if the outcomes differ: then nothing else is compared.
  bool compareOutcome(const Pair& pair) {
    const auto &a = text(pair, "outcome", false), &b = text(pair, "outcome", true);
    if (a == b) return true;
    const std::string success(name(Outcome::kSuccess));
    add(Kind::kOutcome, pair, fmt::format("{} -> {}", a, b), a == success || b == success ? 2 : 1);
    return false;
  }

  // All changed counters of a run are reported as one difference, of the size of the largest change.
  void compareCounters(const Pair& pair) {
    std::string what;
    double most = 0;
    for (const auto& column : counters_) {
      const auto &a = text(pair, column, false), &b = text(pair, column, true);
      const double x = cellNumber(a), y = cellNumber(b);
      if (a == b || std::abs(x - y) <= limits_.counters * std::max(x, y)) continue;
      what += fmt::format("{}{} {} -> {}", what.empty() ? "" : ", ", column, a, b);
      most = std::max(most, factorOf(x, y));
    }
    if (!what.empty()) add(Kind::kCounter, pair, std::move(what), most);
  }

  double roundOff(const Pair& pair) const {
    if (!first_.table.hasColumn("scalar")) return kRoundOff * epsilonOf(ScalarKind::kDouble);
    return kRoundOff * epsilonOf(parseId<ScalarKind>(text(pair, "scalar", false)));
  }

  // Like counters: one difference per run. Errors below round-off are not compared.
  void compareErrors(const Pair& pair) {
    const double least = roundOff(pair);
    std::string what;
    double most = 0;
    for (const auto& column : errors_) {
      const auto &a = text(pair, column, false), &b = text(pair, column, true);
      const auto shown = [least](double x) { return std::isnan(x) ? x : std::max(std::abs(x), least); };
      const double factor = factorOf(shown(cellNumber(a)), shown(cellNumber(b)));
      if (factor <= limits_.errors) continue;
      what += fmt::format("{}{} {:.3g} -> {:.3g}", what.empty() ? "" : ", ", column, cellNumber(a), cellNumber(b));
      most = std::max(most, factor);
    }
    if (!what.empty()) add(Kind::kError, pair, std::move(what), most);
  }

  static std::string processorOf(const Runs& runs, const TableRow& row) {
    if (runs.table.hasColumn("cpu_environment")) {
      const auto found = runs.processors.find(textAt(runs.table, row, "cpu_environment"));
      if (found != runs.processors.end()) return found->second;
    }
    for (const auto& [key, value] : runs.table.head) {
      if (key == "cpu") return value;
    }
    return "unknown";
  }

  // The repetitions of the timing pass; empty if the run was not timed.
  static std::vector<double> repetitions(const Runs& runs, const TableRow& row) {
    std::vector<double> seconds;
    if (!runs.table.hasColumn("cpu_s") || !runs.table.hasColumn("cpu_runs")) return seconds;
    if (!(numberAt(runs.table, row, "cpu_runs") > 0)) return seconds;
    if (runs.table.hasColumn("cpu_all")) {
      std::istringstream in(textAt(runs.table, row, "cpu_all"));
      for (std::string word; in >> word;) seconds.push_back(cellNumber(word));
    }
    if (seconds.size() < kFew) seconds = {numberAt(runs.table, row, "cpu_s")};
    std::erase_if(seconds, [](double t) { return !(t > 0) || std::isinf(t); });
    return seconds;
  }

  void noteTimes(const Pair& pair) {
    if (!succeededAt(first_.table, *pair.first)) return;
    Timed timed{pair, repetitions(first_, *pair.first), repetitions(second_, *pair.second), false};
    if (timed.first.empty() || timed.second.empty()) {
      ++result_.times.not_timed;
      return;
    }
    const auto a = processorOf(first_, *pair.first), b = processorOf(second_, *pair.second);
    if (a != b) {
      ++result_.times.other_processor;
      result_.times.processors = fmt::format("'{}' and '{}'", a, b);
      return;
    }
    timed.few = std::min(timed.first.size(), timed.second.size()) < kFew;
    if (timed.few) {
      for (auto* seconds : {&timed.first, &timed.second}) {
        *seconds = {*std::min_element(seconds->begin(), seconds->end())};
      }
      ++result_.times.few;
    }
    timed_.push_back(std::move(timed));
  }

  // alpha is the level of all tests together: each of m runs is tested with alpha / m.
  void judgeTimes() {
    result_.times.compared = timed_.size();
    if (timed_.empty()) return;
    const double alpha = limits_.alpha / static_cast<double>(timed_.size());
    std::vector<double> ratios;
    for (const auto& timed : timed_) {
      const Ratio ratio = ratioOf(timed.first, timed.second, alpha);
      ratios.push_back(ratio.ratio);
      const double factor = factorOf(1, ratio.ratio);
      const double noise = timed.few ? std::max(kFewFactor, 1 + limits_.times) : 1 + limits_.times;
      if (ratio.low <= noise && ratio.high >= 1 / noise) continue;
      const auto how = timed.few ? std::string("minima of fewer than five repetitions")
                                 : fmt::format("{:.3g} to {:.3g}", ratio.low, ratio.high);
      add(Kind::kTime, timed.pair, fmt::format("time x {:.3g} ({})", ratio.ratio, how), factor);
    }
    std::sort(ratios.begin(), ratios.end());
    result_.times.least = ratios.front();
    result_.times.median = ratios[ratios.size() / 2];
    result_.times.most = ratios.back();
  }

  const Runs& first_;
  const Runs& second_;
  const Limits& limits_;
  Matching matching_;
  std::vector<std::string> counters_, errors_;
  std::vector<Timed> timed_;
  Comparison result_;
};

}  // namespace

Comparison compareRuns(const Runs& first, const Runs& second, const Limits& limits) {
  return Comparer(first, second, limits).run();
}

}  // namespace irk::compare
