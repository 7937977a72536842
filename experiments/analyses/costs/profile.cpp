#include "experiments/analyses/costs/profile.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "experiments/analyses/costs/cost_at_error.h"
#include "experiments/analyses/results.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/analysis.h"
#include "irk/collections.h"

namespace irk {
namespace {

constexpr double kEnd = 1e6;  // where the curves end

// Solver -> problem that it was given -> time; infinity if the solver does not solve it.
using Costs = std::map<std::string, std::map<std::string, double>>;

// The least time of every problem that some solver solves.
std::map<std::string, double> bestTimes(const Costs& costs) {
  std::map<std::string, double> best;
  for (const auto& [solver, times] : costs) {
    for (const auto& [problem, time] : times) {
      if (std::isinf(time)) continue;
      const auto [at, added] = best.try_emplace(problem, time);
      if (!added) at->second = std::min(at->second, time);
    }
  }
  return best;
}

void appendProfile(const std::string& collection, const std::string& target, const Costs& costs, Table& table) {
  const auto best = bestTimes(costs);
  const std::string problems = std::to_string(best.size());
  for (const auto& [solver, times] : costs) {
    std::vector<double> ratios;  // time over best time, of the problems that it solves
    std::size_t given = 0;
    for (const auto& [problem, time] : times) {
      const auto solved = best.find(problem);
      if (solved == best.end()) continue;
      ++given;
      if (!std::isinf(time)) ratios.push_back(time / solved->second);
    }
    if (given == 0) continue;
    std::sort(ratios.begin(), ratios.end());
    const auto addRow = [&](double ratio, std::size_t count) {
      const double fraction = static_cast<double>(count) / static_cast<double>(given);
      table.rows.push_back(
          {collection, target, solver, numberText(ratio), numberText(fraction), std::to_string(given), problems});
    };
    if (ratios.empty()) addRow(1, 0);
    for (std::size_t i = 0; i < ratios.size(); ++i) addRow(ratios[i], i + 1);
    addRow(kEnd, ratios.size());
  }
}

// Whether the solver was asked for this error: with larger tolerances only, it has not failed where it does not reach
// the error.
bool wasAsked(const Table& costs, const TableRow& row) {
  if (!costs.hasColumn("least_tolerance")) return true;
  const double least = numberAt(costs, row, "least_tolerance");
  return !(least > numberAt(costs, row, "target_error") * (1 + 1e-9));
}

}  // namespace

Table profileTable(const Table& costs) {
  Table table{costs.head, {"collection", "target_error", "integrator", "ratio", "fraction", "given", "problems"}, {}};
  std::map<std::pair<std::string, std::string>, Costs> curves;  // collection and target
  for (const auto& row : costs.rows) {
    const auto& target = textAt(costs, row, "target_error");
    const std::string problem = textAt(costs, row, "scene") + " " + textAt(costs, row, "settings");
    const auto& solver = textAt(costs, row, "integrator");
    const auto& cause = textAt(costs, row, "cause");
    if (cause == kNoReference || cause == kNotMeasurable || cause == kNotApplicable || !wasAsked(costs, row)) continue;
    const double cost = numberAt(costs, row, "cpu_s");
    const double time = std::isnan(cost) ? std::numeric_limits<double>::infinity() : cost;
    auto collections = collectionsOf(textAt(costs, row, "scene"));
    collections.emplace_back("all");
    for (const auto& collection : collections) {
      for (const auto& [key, name] : {std::pair(target, problem), {"all", problem + " " + target}}) {
        const auto [at, added] = curves[{collection, key}][solver].try_emplace(name, time);
        if (!added) at->second = std::min(at->second, time);
      }
    }
  }
  for (const auto& [key, solvers] : curves) appendProfile(key.first, key.second, solvers, table);
  return table;
}

Analysis profileAnalysis() {
  return {.id = "profile",
          .key = "profile",
          .meaning = "performance profiles of integrators at the errors of `targets`",
          .reads = "cpu_at_error.csv",
          .writes = "profile.csv",
          .needs = "targets",
          .run = [](const AnalysisInput& in) -> std::vector<std::string> {
            // Without times no profile is written, and an older one must not remain beside these runs.
            if (refusedTimes(in.runs.head).empty()) {
              writeTable(in.folder / "profile.csv", profileTable(readTable(in.folder / "cpu_at_error.csv")));
            } else {
              std::filesystem::remove(in.folder / "profile.csv");
            }
            return {};
          }};
}

}  // namespace irk
