#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "experiments/audit/audit.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/run_table.h"

namespace irk::audit {
namespace {

// A way to group the rows of an audit; rows with an empty group are left out.
struct Grouping {
  const char* by;
  std::string (*group)(const Table&, const TableRow&);
};

bool hasToBeRight(const std::string& treatment) {
  return treatment == kDefaultTreatment || treatment == kNoSwitches || treatment == idOf(Discontinuity::kLocate);
}

template <const char* const& Column>
std::string cell(const Table& t, const TableRow& row) {
  return textAt(t, row, Column);
}
constexpr const char* kConfiguration = "configuration";
constexpr const char* kTreatment = "treatment";
constexpr const char* kScene = "scene";
constexpr const char* kFamily = "family";
constexpr const char* kFormulation = "formulation";

constexpr Grouping kGroupings[] = {
    {"all", [](const Table&, const TableRow&) { return std::string("all"); }},
    {"configuration", cell<kConfiguration>},
    {"bar",
     [](const Table& t, const TableRow& row) {
       return hasToBeRight(textAt(t, row, "treatment")) ? textAt(t, row, "configuration") : std::string();
     }},
    {"treatment", cell<kTreatment>},
    {"formulation", cell<kFormulation>},
    {"configuration_treatment",
     [](const Table& t, const TableRow& row) {
       return textAt(t, row, "configuration") + ": " + textAt(t, row, "treatment");
     }},
    {"family", cell<kFamily>},
    {"scene", cell<kScene>},
};

using Counts = std::array<int, 5>;

Counts& operator+=(Counts& counts, std::string_view judgement) {
  const auto names = judgementNames();
  const auto at = std::find(names.begin(), names.end(), judgement);
  if (at != names.end()) ++counts[static_cast<std::size_t>(at - names.begin())];
  return counts;
}

std::vector<const TableRow*> wrongOnes(const Table& audit) {
  std::vector<const TableRow*> wrong;
  for (const auto& row : audit.rows) {
    if (textAt(audit, row, "judgement") == nameOf(Judgement::kWrong)) wrong.push_back(&row);
  }
  // The ratio of the error to the bar.
  const auto excess = [&](const TableRow* row) {
    return numberAt(audit, *row, "error") / bar(numberAt(audit, *row, "tolerance"));
  };
  std::stable_sort(wrong.begin(), wrong.end(),
                   [&](const TableRow* a, const TableRow* b) { return excess(a) > excess(b); });
  return wrong;
}

}  // namespace

Table summaryTable(const Table& audit) {
  Table table{audit.head, {"by", "group", "runs"}, {}};
  for (const auto name : judgementNames()) table.columns.emplace_back(name);
  for (const auto& grouping : kGroupings) {
    std::map<std::string, Counts> groups;
    for (const auto& row : audit.rows) {
      const std::string group = grouping.group(audit, row);
      if (!group.empty()) groups[group] += textAt(audit, row, "judgement");
    }
    for (const auto& [group, counts] : groups) {
      int all = 0;
      for (const int count : counts) all += count;
      TableRow row{grouping.by, group, std::to_string(all)};
      for (const int count : counts) row.push_back(std::to_string(count));
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

std::string summaryText(const Table& audit, const Table& summary, std::size_t worst) {
  std::string text;
  const auto print = [&](std::string_view by, std::string_view title) {
    text += fmt::format("{:<42}{:>7}", title, "runs");
    for (const auto name : judgementNames()) text += fmt::format("{:>16}", name);
    text += '\n';
    for (const auto& row : summary.rows) {
      if (row[0] != by) continue;
      text += fmt::format("  {:<40}{:>7}", row[1], row[2]);
      for (std::size_t i = 3; i < row.size(); ++i) text += fmt::format("{:>16}", row[i]);
      text += '\n';
    }
  };
  print("configuration", "by configuration");
  print("bar", "the same, switches by default or located");
  const auto wrong = wrongOnes(audit);
  if (!wrong.empty()) {
    const auto unseen = std::count_if(wrong.begin(), wrong.end(), [&](const TableRow* row) {
      return !(numberAt(audit, *row, "error") <= numberAt(audit, *row, "accumulated"));
    });
    text += fmt::format(
        "{} of {} wrong successes are off by more than steps x kappa x tolerance, what local errors of one tolerance "
        "can "
        "add up to\nthe worst successes that are wrong:\n",
        unseen, wrong.size());
  }
  for (std::size_t i = 0; i < std::min(worst, wrong.size()); ++i) {
    text +=
        fmt::format("  error {:.1e}  {}\n", numberAt(audit, *wrong[i], "error"), textAt(audit, *wrong[i], "command"));
  }
  return text;
}

}  // namespace irk::audit
