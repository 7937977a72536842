#include "experiments/analyses/costs/profile.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "experiments/analyses/costs/solver_costs.h"
#include "experiments/analyses/results.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/analysis.h"
#include "irk/collections.h"

namespace irk {
namespace {

constexpr double kEnd = 1e6;  // where the curves end

void appendProfile(const TableRow& start, const SolverCosts& costs, TableWriter& table) {
  const auto least = leastCosts(costs);
  for (const auto& [solver, problems] : costs) {
    std::vector<double> ratios;  // time over least time, of the problems that it solves
    std::size_t given = 0;
    for (const auto& [problem, time] : problems) {
      const auto best = least.find(problem);
      if (best == least.end()) continue;
      ++given;
      if (std::isfinite(time)) ratios.push_back(time / best->second);
    }
    if (given == 0) continue;
    std::sort(ratios.begin(), ratios.end());
    const auto addRow = [&, &name = solver](double ratio, std::size_t count) {
      const double fraction = static_cast<double>(count) / static_cast<double>(given);
      TableRow row = start;
      row.insert(row.end(),
                 {name, numberText(ratio), numberText(fraction), std::to_string(given), std::to_string(least.size())});
      table.add(row);
    };
    if (ratios.empty()) addRow(1, 0);
    for (std::size_t i = 0; i < ratios.size(); ++i) addRow(ratios[i], i + 1);
    addRow(kEnd, ratios.size());
  }
}

}  // namespace

void writeProfile(const std::filesystem::path& costs, const std::filesystem::path& file) {
  std::map<std::pair<std::string, std::string>, SolverCosts> curves;  // by collection and target error
  const Table names = forEachRow(costs, [&](const Table& columns, const TableRow& row) {
    auto collections = collectionsOf(textAt(columns, row, "scene"));
    collections.emplace_back("all");
    for (const auto& collection : collections) {
      for (const std::string& target : {textAt(columns, row, "target_error"), std::string("all")}) {
        addCost(columns, row, "integrator", curves[{collection, target}]);
      }
    }
  });
  TableWriter table(file, names.head,
                    {"collection", "target_error", "integrator", "ratio", "fraction", "given", "problems"});
  for (const auto& [curve, its] : curves) appendProfile({curve.first, curve.second}, its, table);
  table.close();
}

Analysis profileAnalysis() {
  return {.key = "profile",
          .meaning = "performance profiles of integrators at the errors of `targets`",
          .reads = "cpu_at_error.csv",
          .writes = "profile.csv",
          .needs = "targets",
          .run = [](const AnalysisInput& in) {
            // Without times no profile is written, and an older one must not remain beside these runs.
            if (refusedTimes(in.runs.names().head).empty()) {
              writeProfile(in.folder / "cpu_at_error.csv", in.folder / "profile.csv");
            } else {
              std::filesystem::remove(in.folder / "profile.csv");
            }
          }};
}

}  // namespace irk
