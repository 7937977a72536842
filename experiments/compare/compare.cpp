#include "experiments/compare/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "experiments/base/numbers.h"
#include "experiments/compare/matching.h"
#include "experiments/compare/times.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/run_table.h"
#include "irk/misuse.h"

namespace irk::compare {
namespace {

constexpr std::string_view kErrors[] = {"error",   "error_u", "error_v",         "error_x",
                                        "error_z", "drift",   "invariant_change"};
// Errors below this many units of round-off of their scalar are not compared: 1.1e-14 in double precision.
constexpr double kRoundOff = 50;

/// A column that both tables have.
struct Column {
  std::string name;
  std::size_t first, second;

  const std::string& of(const TableRow& row, bool is_second) const { return row[is_second ? second : first]; }
};

bool isWorse(const Difference& a, const Difference& b) {
  return a.size != b.size ? a.size > b.size : a.order < b.order;
}

/// Compares two tables row by row.
class Comparer {
 public:
  Comparer(const Runs& first, const Runs& second, const Limits& limits)
      : limits_(limits), matching_(first.file, second.file), times_(first, second, limits, matching_) {
    for (const auto* names : {&matching_.firstNames(), &matching_.secondNames()}) {
      if (!names->hasColumn("outcome")) throw Misuse("no table of runs: it has no column 'outcome'");
    }
    outcome_ = columnOf("outcome").value();
    scalar_ = columnOf("scalar");
    chooseColumns();
    result_.first = matching_.firstRows();
    result_.second = matching_.secondRows();
  }

  Comparison run() {
    matching_.forEachPair([this](const Pair& pair) { compare(pair); });
    result_.times = times_.judge(
        [this](const Pair& pair, std::string what, double size) { add(Kind::kTime, pair, std::move(what), size); });
    for (auto& worst : worst_) std::move(worst.begin(), worst.end(), std::back_inserter(result_.differences));
    return std::move(result_);
  }

 private:
  std::optional<Column> columnOf(std::string_view name) const {
    const Table &a = matching_.firstNames(), &b = matching_.secondNames();
    if (!a.hasColumn(name) || !b.hasColumn(name)) return {};
    return Column{std::string(name), a.column(name), b.column(name)};
  }

  void chooseColumns() {
    const auto choose = [this](std::string_view name, std::vector<Column>* chosen) {
      const auto column = columnOf(name);
      if (column && chosen) chosen->push_back(*column);
      const bool a = matching_.firstNames().hasColumn(name), b = matching_.secondNames().hasColumn(name);
      if (a != b) {
        result_.not_compared.push_back(fmt::format("{} (only in the {})", name, a ? "first" : "second"));
      }
    };
    Counters{}.forEach([&](const char* name, std::int64_t) { choose(name, &counters_); });
    for (const auto name : kErrors) choose(name, &errors_);
    for (const auto& field : specFields()) choose(field.name, nullptr);
  }

  void compare(const Pair& pair) {
    if (!pair.first || !pair.second) {
      add(Kind::kMissing, pair, pair.first ? "only in the first" : "only in the second", 1);
      return;
    }
    ++result_.both;
    const auto &a = outcome_.of(*pair.first, false), &b = outcome_.of(*pair.second, true);
    const std::string_view success = name(Outcome::kSuccess);
    if (a != b) {  // then nothing else is compared
      add(Kind::kOutcome, pair, fmt::format("{} -> {}", a, b), a == success || b == success ? 2 : 1);
      return;
    }
    compareCounters(pair);
    compareErrors(pair);
    if (a == success) times_.note(pair);
  }

  // Keeps the difference if it is one of the worst.
  void add(Kind kind, const Pair& pair, std::string what, double size) {
    const auto at = static_cast<std::size_t>(kind);
    ++result_.counts[at];
    auto& worst = worst_[at];
    Difference difference{kind, {}, std::move(what), size, pair.order()};
    if (worst.size() == kWorst && !isWorse(difference, worst.back())) return;
    difference.run = matching_.nameOf(pair);
    worst.insert(std::upper_bound(worst.begin(), worst.end(), difference, isWorse), std::move(difference));
    if (worst.size() > kWorst) worst.pop_back();
  }

  // All changed counters of a run are reported as one difference, of the size of the largest change.
  void compareCounters(const Pair& pair) {
    std::string what;
    double most = 0;
    for (const auto& column : counters_) {
      const auto &a = column.of(*pair.first, false), &b = column.of(*pair.second, true);
      if (a == b) continue;
      const double x = cellNumber(a), y = cellNumber(b);
      if (std::abs(x - y) <= limits_.counters * std::max(x, y)) continue;
      what += fmt::format("{}{} {} -> {}", what.empty() ? "" : ", ", column.name, a, b);
      most = std::max(most, factorOf(x, y));
    }
    if (!what.empty()) add(Kind::kCounter, pair, std::move(what), most);
  }

  double roundOff(const Pair& pair) const {
    return kRoundOff * epsilonOf(scalar_ ? parseId<ScalarKind>(scalar_->of(*pair.first, false)) : ScalarKind{});
  }

  // Like counters: one difference per run. Errors below round-off are not compared.
  void compareErrors(const Pair& pair) {
    const double least = roundOff(pair);
    std::string what;
    double most = 0;
    for (const auto& column : errors_) {
      const auto &a = column.of(*pair.first, false), &b = column.of(*pair.second, true);
      if (a == b) continue;
      const double x = cellNumber(a), y = cellNumber(b);
      const auto shown = [least](double e) { return std::isnan(e) ? e : std::max(std::abs(e), least); };
      const double factor = factorOf(shown(x), shown(y));
      if (factor <= limits_.errors) continue;
      what += fmt::format("{}{} {:.3g} -> {:.3g}", what.empty() ? "" : ", ", column.name, x, y);
      most = std::max(most, factor);
    }
    if (!what.empty()) add(Kind::kError, pair, std::move(what), most);
  }

  const Limits& limits_;
  Matching matching_;
  TimeComparer times_;
  Column outcome_;
  std::optional<Column> scalar_;
  std::vector<Column> counters_, errors_;
  std::array<std::vector<Difference>, kKindCount> worst_;  // by kind
  Comparison result_;
};

}  // namespace

Comparison compareRuns(const Runs& first, const Runs& second, const Limits& limits) {
  return Comparer(first, second, limits).run();
}

}  // namespace irk::compare
