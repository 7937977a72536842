#include "experiments/profile.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include "experiments/numbers.h"
#include "experiments/run_table.h"

namespace irk {
namespace {

constexpr double kEnd = 1e6;  // where the curves end

// Solver -> problem -> time.
using Costs = std::map<std::string, std::map<std::string, double>>;

void appendProfile(const std::string& target, const Costs& costs, Table& table) {
  std::map<std::string, double> best;
  for (const auto& [solver, times] : costs) {
    for (const auto& [problem, time] : times) {
      const auto [at, added] = best.try_emplace(problem, time);
      if (!added) at->second = std::min(at->second, time);
    }
  }
  const double problems = static_cast<double>(best.size());
  for (const auto& [solver, times] : costs) {
    std::vector<double> ratios;
    for (const auto& [problem, time] : times) ratios.push_back(time / best.at(problem));
    std::sort(ratios.begin(), ratios.end());
    if (ratios.empty()) table.rows.push_back({target, solver, "1", "0"});
    ratios.push_back(kEnd);
    for (std::size_t i = 0; i < ratios.size(); ++i) {
      table.rows.push_back({target, solver, numberText(ratios[i]),
                            numberText(static_cast<double>(std::min(i + 1, times.size())) / problems)});
    }
  }
}

}  // namespace

Table profileTable(const Table& costs) {
  Table table{costs.head, {"target_error", "integrator", "ratio", "fraction"}, {}};
  std::map<std::string, Costs> by_target;
  for (const auto& row : costs.rows) {
    const auto& target = textAt(costs, row, "target_error");
    const std::string problem =
        textAt(costs, row, "scene") + " " + textAt(costs, row, "settings");
    const auto& solver = textAt(costs, row, "integrator");
    const double time = numberAt(costs, row, "cpu_s");
    for (const auto& [key, name] : {std::pair(target, problem), {"all", problem + " " + target}}) {
      auto& times = by_target[key][solver];
      if (std::isnan(time)) continue;
      const auto [at, added] = times.try_emplace(name, time);
      if (!added) at->second = std::min(at->second, time);
    }
  }
  for (const auto& [target, solvers] : by_target) appendProfile(target, solvers, table);
  return table;
}

}  // namespace irk
