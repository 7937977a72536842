#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "experiments/audit/audit.h"
#include "experiments/audit/bar_tables.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/run_table.h"
#include "experiments/tables/table_rows.h"

namespace irk::audit {
namespace {

// A way to group the rows of an audit; rows with an empty group are left out.
struct Grouping {
  const char* by;
  std::string (*group)(const Table&, const TableRow&);
  bool of_others = false;  // of the integrators of other libraries, else of ours
};

// The configuration, or the id of another library's integrator.
constexpr const char* kIntegrator = "integrator";
constexpr const char* kConfiguration = "configuration";

bool isOurs(const Table& t, const TableRow& row) {
  return textAt(t, row, kIntegrator) == textAt(t, row, kConfiguration);
}

bool hasToBeRight(const std::string& treatment) {
  return treatment == kDefaultTreatment || treatment == kNoSwitches || treatment == idOf(Discontinuity::kLocate);
}

template <const char* const& Column>
std::string cell(const Table& t, const TableRow& row) {
  return textAt(t, row, Column);
}
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
    {"other_library", cell<kIntegrator>, true},
};

// Successes with an error above the bar that the judgement does not count: of runs that are set aside, of multipliers,
// and at earlier times.
constexpr const char* kBeside[] = {"wrong_set_aside", "wrong_z", "wrong_way"};

// The judgements in their order, then those of kBeside.
using Counts = std::array<int, 5 + std::size(kBeside)>;

void add(Counts& counts, const Table& t, const TableRow& row) {
  const auto names = judgementNames();
  const std::string& judgement = textAt(t, row, "judgement");
  const auto at = std::find(names.begin(), names.end(), judgement);
  if (at != names.end()) ++counts[static_cast<std::size_t>(at - names.begin())];
  if (!succeededAt(t, row)) return;
  const bool aside = judgement == nameOf(Judgement::kIllConditioned);
  const double largest = bar(numberAt(t, row, "tolerance"));
  const auto isAbove = [&](const char* error) { return numberAt(t, row, error) > largest; };
  std::size_t beside = names.size();
  counts[beside++] += aside && isAbove("error");
  counts[beside++] += !aside && isAbove("error_z");
  counts[beside] += !aside && isAbove("error_way");
}

struct WrongSuccess {
  double excess;  // the ratio of its error to the bar
  double error;
  std::string command;
};

struct WrongSuccesses {
  std::size_t count = 0;
  std::size_t unseen = 0;           // with an error larger than local errors of one tolerance can add up to
  std::vector<WrongSuccess> worst;  // the first of equal ones first
};

WrongSuccesses wrongOnes(const std::filesystem::path& file, std::size_t most) {
  WrongSuccesses wrong;
  forEachRow(file, [&](const Table& audit, const TableRow& row) {
    const bool ours = isOurs(audit, row);
    if (!ours || textAt(audit, row, "judgement") != nameOf(Judgement::kWrong)) return;
    const double error = numberAt(audit, row, "error");
    ++wrong.count;
    if (!(error <= numberAt(audit, row, "accumulated"))) ++wrong.unseen;
    const WrongSuccess one{error / bar(numberAt(audit, row, "tolerance")), error, textAt(audit, row, "command")};
    const auto at = std::upper_bound(wrong.worst.begin(), wrong.worst.end(), one,
                                     [](const auto& a, const auto& b) { return a.excess > b.excess; });
    wrong.worst.insert(at, one);
    if (wrong.worst.size() > most) wrong.worst.pop_back();
  });
  return wrong;
}

}  // namespace

Table summaryTable(const std::filesystem::path& file) {
  std::map<std::string, Counts> groups[std::size(kGroupings)];
  const Table audit = forEachRow(file, [&](const Table& names, const TableRow& row) {
    const bool ours = isOurs(names, row);
    for (std::size_t by = 0; by < std::size(kGroupings); ++by) {
      if (kGroupings[by].of_others == ours) continue;
      const std::string group = kGroupings[by].group(names, row);
      if (!group.empty()) add(groups[by][group], names, row);
    }
  });
  Table table{audit.head, {"by", "group", "runs"}, {}};
  for (const auto name : judgementNames()) table.columns.emplace_back(name);
  table.columns.insert(table.columns.end(), std::begin(kBeside), std::end(kBeside));
  for (std::size_t by = 0; by < std::size(kGroupings); ++by) {
    for (const auto& [group, counts] : groups[by]) {
      int all = 0;
      for (std::size_t i = 0; i < judgementNames().size(); ++i) all += counts[i];
      TableRow row{kGroupings[by].by, group, std::to_string(all)};
      for (const int count : counts) row.push_back(std::to_string(count));
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

std::string summaryText(const std::filesystem::path& audit, const Table& summary, std::size_t worst) {
  Titles titles;
  for (std::size_t i = 2; i < summary.columns.size(); ++i) titles.emplace_back(summary.columns[i], summary.columns[i]);
  std::string text = linesOf(summary, "by configuration", {"configuration"}, titles) +
                     linesOf(summary, "the same, switches by default or located", {"bar"}, titles) +
                     linesOf(summary, "other libraries", {"other_library"}, titles);
  const auto wrong = wrongOnes(audit, worst);
  if (wrong.count > 0) {
    text += fmt::format(
        "{} of {} wrong successes are off by more than steps x kappa x tolerance, what local errors of one tolerance "
        "can "
        "add up to\nthe worst successes that are wrong:\n",
        wrong.unseen, wrong.count);
  }
  for (const auto& one : wrong.worst) text += fmt::format("  error {:.1e}  {}\n", one.error, one.command);
  return text;
}

}  // namespace irk::audit
