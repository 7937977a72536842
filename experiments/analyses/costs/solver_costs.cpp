#include "experiments/analyses/costs/solver_costs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/analyses/costs/cost_at_error.h"
#include "experiments/runs/run_table.h"

namespace irk {
namespace {

void keepLess(std::map<std::string, double>& costs, const std::string& problem, double cost) {
  const auto [at, added] = costs.try_emplace(problem, cost);
  if (!added) at->second = std::min(at->second, cost);
}

}  // namespace

void addCost(const Table& costs, const TableRow& row, std::string_view solver, SolverCosts& found) {
  if (!isComparable(costs, row)) return;
  const std::string problem =
      fmt::format("{} {} {} {}", textAt(costs, row, "scene"), textAt(costs, row, "settings"),
                  costs.hasColumn("t_end") ? textAt(costs, row, "t_end") : "", textAt(costs, row, "target_error"));
  const double cost = numberAt(costs, row, "cpu_s");
  keepLess(found[textAt(costs, row, solver)], problem,
           std::isnan(cost) ? std::numeric_limits<double>::infinity() : cost);
}

std::map<std::string, double> leastCosts(const SolverCosts& costs) {
  std::map<std::string, double> least;
  for (const auto& [solver, problems] : costs) {
    for (const auto& [problem, cost] : problems) {
      if (std::isfinite(cost)) keepLess(least, problem, cost);
    }
  }
  return least;
}

}  // namespace irk
