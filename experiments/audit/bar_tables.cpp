#include "experiments/audit/bar_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "experiments/audit/judge.h"
#include "experiments/audit/thresholds.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/run_table.h"
#include "experiments/tables/named_cells.h"
#include "experiments/tables/table_rows.h"

namespace irk::audit {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr double kOfBar = 0.1;  // a reference is known if it is this part of the bar, as for the judgement

// What the tables need of a row of audit.csv.
struct Facts {
  bool success, measured, by_peer, to_the_end;
  double tolerance, error, in_tolerances, accuracy, bar, part_of_cover, cost;

  bool known() const { return accuracy <= kOfBar * audit::bar(tolerance) && !std::isnan(error); }
};

Facts factsIn(const Table& t, const TableRow& row) {
  const auto number = [&](std::string_view column) { return numberAt(t, row, column); };
  const std::string& outcome = textAt(t, row, "outcome");
  const double error_bar = number("error_bar"), second = number("cpu_error_bar_s");
  return {.success = succeededAt(t, row),
          .measured = !std::isnan(error_bar),
          .by_peer = textAt(t, row, "integrator") != textAt(t, row, "configuration"),
          .to_the_end = outcome == "success" || outcome == "inaccurate" || outcome == "drift",
          .tolerance = number("tolerance"),
          .error = number("error"),
          .in_tolerances = number("error_in_tolerances"),
          .accuracy = number("accuracy"),
          .bar = error_bar,
          .part_of_cover = number("part_of_cover"),
          .cost = second / number("cpu_s")};
}

struct Bars {
  int successes = 0, unknown = 0, judged = 0, covered = 0, near = 0, false_alarms = 0;
  std::vector<double> sharpness, costs;

  void add(const Facts& run) {
    if (run.success) {
      ++successes;
      if (!run.measured) ++unknown;
      if (run.known() && !std::isnan(run.part_of_cover)) {
        ++judged;
        if (run.part_of_cover <= 1) ++covered;
      }
      const bool measurable = run.error >= kCoverageRoundOff && run.error >= 10 * run.accuracy;
      if (run.known() && run.measured && measurable && std::isfinite(run.error)) {
        sharpness.push_back(run.bar / run.error);
      }
    }
    if (run.to_the_end && run.known() && run.in_tolerances < kRightTolerances) {
      ++near;
      if (!run.success) ++false_alarms;
    }
    if (std::isfinite(run.cost)) costs.push_back(run.cost);
  }
};

// The smallest value that at least this part of them does not exceed.
double quantile(std::vector<double> values, double part) {
  if (values.empty()) return kUnknown;
  std::sort(values.begin(), values.end());
  const auto rank = static_cast<std::size_t>(std::ceil(part * static_cast<double>(values.size())));
  return values[std::max<std::size_t>(rank, 1) - 1];
}

double share(int part, std::size_t all) { return all == 0 ? kUnknown : part / static_cast<double>(all); }

NamedCells barCells(const std::string& by, const std::string& group, const Bars& b) {
  const auto sharp = std::count_if(b.sharpness.begin(), b.sharpness.end(),
                                   [](double ratio) { return ratio >= kSharpFrom && ratio <= kSharpTo; });
  const auto text = [](double value) { return fmt::format("{:.4g}", value); };
  return {{"by", by},
          {"group", group},
          {"successes", std::to_string(b.successes)},
          {"unknown", std::to_string(b.unknown)},
          {"judged", std::to_string(b.judged)},
          {"covered", std::to_string(b.covered)},
          {"coverage", text(share(b.covered, static_cast<std::size_t>(b.judged)))},
          {"sharp_runs", std::to_string(b.sharpness.size())},
          {"sharp_10", text(quantile(b.sharpness, 0.1))},
          {"sharp_median", text(quantile(b.sharpness, 0.5))},
          {"sharp_90", text(quantile(b.sharpness, 0.9))},
          {"sharp_share", text(share(static_cast<int>(sharp), b.sharpness.size()))},
          {"near_runs", std::to_string(b.near)},
          {"false_alarms", std::to_string(b.false_alarms)},
          {"false_share", text(share(b.false_alarms, static_cast<std::size_t>(b.near)))},
          {"cost_runs", std::to_string(b.costs.size())},
          {"cost_median", text(quantile(b.costs, 0.5))}};
}

struct Words {
  int runs = 0, successes = 0, judged = 0, above_100 = 0, above_1000 = 0;

  void add(const Facts& run) {
    ++runs;
    // An error bar is measured only for what the solver calls a success.
    if (!run.success && !run.measured) return;
    ++successes;
    if (!run.known()) return;
    ++judged;
    if (run.error > kRightTolerances * run.tolerance + 1e-9) ++above_100;
    if (run.error > kLargeTolerances * run.tolerance + 1e-9) ++above_1000;
  }
};

template <class Group>
using Groups = std::vector<std::pair<std::string, std::map<std::string, Group>>>;

// Adds a row to its group of each kind; all are in the order of `kinds`, the groups sorted.
template <class Group>
void add(Groups<Group>& groups, std::size_t kind, const std::string& group, const Facts& run) {
  groups[kind].second[group].add(run);
}

}  // namespace

Table errorBarTable(const std::filesystem::path& audit) {
  Groups<Bars> groups;
  for (const char* kind : {"all", "configuration", "collection", "family", "scene"}) groups.push_back({kind, {}});
  const Table names = forEachRow(audit, [&](const Table& t, const TableRow& row) {
    const Facts run = factsIn(t, row);
    if (run.by_peer) return;
    add(groups, 0, "all", run);
    for (std::size_t kind = 1; kind < groups.size(); ++kind) {
      add(groups, kind, textAt(t, row, groups[kind].first), run);
    }
  });
  Table table{names.head, {}, {}};
  for (const auto& [by, all] : groups) {
    for (const auto& [group, bars] : all) addRow(table, barCells(by, group, bars));
  }
  return table;
}

Table ownWordTable(const std::filesystem::path& audit) {
  Groups<Words> groups{{"all", {}}};
  std::map<std::string, std::map<std::string, Words>> by_collection;
  const Table names = forEachRow(audit, [&](const Table& t, const TableRow& row) {
    const Facts run = factsIn(t, row);
    const std::string& integrator = textAt(t, row, "integrator");
    add(groups, 0, integrator, run);
    by_collection[textAt(t, row, "collection")][integrator].add(run);
  });
  groups.insert(groups.end(), by_collection.begin(), by_collection.end());
  Table table{names.head, {}, {}};
  for (const auto& [by, all] : groups) {
    for (const auto& [group, words] : all) {
      addRow(table, {{"by", by},
                     {"group", group},
                     {"runs", std::to_string(words.runs)},
                     {"successes", std::to_string(words.successes)},
                     {"judged", std::to_string(words.judged)},
                     {"above_100", std::to_string(words.above_100)},
                     {"above_1000", std::to_string(words.above_1000)}});
    }
  }
  return table;
}

std::string linesOf(const Table& table, const std::string& head, const std::vector<std::string>& kinds,
                    const Titles& titles) {
  std::string text = fmt::format("{:<42}", head);
  for (const auto& [column, title] : titles) text += fmt::format("{:>16}", title);
  text += '\n';
  for (const auto& kind : kinds) {
    for (const auto& row : table.rows) {
      if (row[0] != kind) continue;
      text += fmt::format("  {:<40}", kinds.size() == 1 || kind == "all" ? row[1] : kind + " " + row[1]);
      for (const auto& [column, title] : titles) text += fmt::format("{:>16}", textAt(table, row, column));
      text += '\n';
    }
  }
  return text;
}

std::string errorBarText(const Table& bars) {
  const std::string text = linesOf(bars, "the error bar", {"all", "configuration", "collection"},
                                   {{"successes", "successes"},
                                    {"unknown", "bar unknown"},
                                    {"judged", "judged"},
                                    {"coverage", "coverage"},
                                    {"sharp_median", "bar / error"},
                                    {"sharp_10", "10 %"},
                                    {"sharp_90", "90 %"},
                                    {"sharp_share", "in .1 to 10"},
                                    {"false_alarms", "false alarms"},
                                    {"near_runs", "of"},
                                    {"cost_median", "second / first"}});
  return text +
         fmt::format(
             "asked: coverage >= {}, median of bar / error {} to {}, in {} to {} >= {}, false alarms <= {}, cost "
             "<= {} (variable {})\n",
             kCoverageAsked, kSharpestMedian, kBluntestMedian, kSharpFrom, kSharpTo, kSharpAsked, kFalseAlarmsAllowed,
             kCostAsked, kCostOfVariableAsked);
}

std::string ownWordText(const Table& words) {
  std::vector<std::string> kinds;
  for (const auto& row : words.rows) {
    if (kinds.empty() || kinds.back() != row[0]) kinds.push_back(row[0]);
  }
  return "the solver's own word, without error bar: errors above 100 and 1000 tolerances as success\n" +
         linesOf(words, "", kinds,
                 {{"runs", "runs"},
                  {"successes", "successes"},
                  {"judged", "judged"},
                  {"above_100", "above 100"},
                  {"above_1000", "above 1000"}});
}

}  // namespace irk::audit
