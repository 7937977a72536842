#include "experiments/analyses/costs/robustness.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <tuple>

#include "experiments/audit/row_judgement.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/analysis.h"
#include "irk/collections.h"

namespace irk {

SolverNames::SolverNames(const RunFile& runs) : names_(runs.names()) {
  std::map<std::string, std::set<std::string>> formulations;
  if (!names_.hasColumn("formulation")) return;
  runs.forEachRow([&](const TableRow& row) {
    if (textAt(names_, row, "outcome") == "refused") return;
    formulations[textAt(names_, row, "integrator")].insert(textAt(names_, row, "formulation"));
  });
  for (const auto& [integrator, used] : formulations) {
    if (used.size() > 1) several_.insert(integrator);
  }
}

std::string SolverNames::of(const TableRow& row) const {
  const std::string& integrator = textAt(names_, row, "integrator");
  return several_.contains(integrator) ? integrator + ":" + textAt(names_, row, "formulation") : integrator;
}

namespace {

struct Counts {
  std::map<audit::Judgement, int> judged;
  std::map<std::string, int> failures;  // outcome -> runs
};

// Of one row of the table; `all` tolerances are -1, before the others.
using GroupKey = std::tuple<std::string, std::string, double>;

std::string failuresText(const std::map<std::string, int>& failures) {
  std::string text;
  for (const auto& [outcome, count] : failures) {
    text += fmt::format("{}{} {}", text.empty() ? "" : "; ", outcome, count);
  }
  return text;
}

}  // namespace

void writeRobustness(const RunFile& runs, const std::filesystem::path& file) {
  const Table& names = runs.names();
  const SolverNames solvers(runs);
  std::map<GroupKey, Counts> groups;
  runs.forEachRow([&](const TableRow& row) {
    const double tolerance = audit::toleranceOf(names, row);
    const auto& outcome = textAt(names, row, "outcome");
    if (outcome == "refused" || std::isnan(tolerance)) return;
    const auto judgement = audit::judgeRow(names, row);
    auto collections = collectionsOf(textAt(names, row, "scene"));
    collections.emplace_back("all");
    for (const auto& collection : collections) {
      for (const double part : {-1.0, tolerance}) {
        Counts& counts = groups[{collection, solvers.of(row), part}];
        ++counts.judged[judgement];
        if (judgement == audit::Judgement::kFailed) ++counts.failures[outcome];
      }
    }
  });
  Table table{names.head,
              {"collection", "integrator", "tolerance", "runs", "right", "failed", "wrong", "unjudged", "outcomes"},
              {}};
  for (auto& [group, counts] : groups) {
    const auto& [collection, integrator, tolerance] = group;
    using audit::Judgement;
    const std::array numbers = {counts.judged[Judgement::kRight], counts.judged[Judgement::kFailed],
                                counts.judged[Judgement::kWrong],
                                counts.judged[Judgement::kUnjudged] + counts.judged[Judgement::kIllConditioned]};
    TableRow row{collection, integrator, tolerance < 0 ? "all" : numberText(tolerance)};
    int sum = 0;
    for (const int number : numbers) sum += number;
    row.push_back(std::to_string(sum));
    for (const int number : numbers) row.push_back(std::to_string(number));
    row.push_back(failuresText(counts.failures));
    table.rows.push_back(std::move(row));
  }
  writeTable(file, table);
}

Analysis robustnessAnalysis() {
  return {.key = "robustness",
          .meaning = "how many runs are right, fail, or are wrong, by collection, solver and tolerance",
          .writes = "robustness.csv",
          .run = [](const AnalysisInput& in) { writeRobustness(in.runs, in.folder / "robustness.csv"); }};
}

}  // namespace irk
