#include "experiments/results.h"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <ostream>
#include <set>

#include "core/misuse.h"
#include "experiments/cost_at_error.h"
#include "experiments/energy.h"
#include "experiments/estimates.h"
#include "experiments/numbers.h"
#include "experiments/orders.h"
#include "experiments/phases.h"
#include "experiments/profile.h"
#include "experiments/run_table.h"
#include "experiments/scaling.h"

namespace irk {
std::vector<std::string> writeSummaries(const Study& study, const Table& runs,
                                        const std::filesystem::path& folder,
                                        std::ostream& progress) {
  if (study.orders) writeTable(folder / "orders.csv", orderTable(runs));
  if (!study.targets.empty()) {
    const Table costs = costTable(runs, study.targets);
    writeTable(folder / "cpu_at_error.csv", costs);
    if (study.profile) writeTable(folder / "profile.csv", profileTable(costs));
  }
  if (study.estimates) writeTable(folder / "estimates.csv", estimateTable(study, runs));
  if (study.scaling) {
    const Table scaling = scalingTable(study, runs, progress);
    writeTable(folder / "scaling.csv", scaling);
    writeTable(folder / "scaling_slopes.csv", scalingSlopes(scaling));
  }
  if (study.energy) writeTable(folder / "energy.csv", energyTable(study, runs));
  if (!study.phases) return {};
  const Table phases = phaseTable(study, runs, progress);
  writeTable(folder / "phases.csv", phases);
  return uncoveredRuns(phases);
}

Table mergedRuns(const std::vector<std::string>& folders) {
  Table merged;
  std::map<std::string, std::size_t> place;
  for (const auto& folder : folders) {
    const auto file = std::filesystem::path(folder) / "runs.csv";
    Table table = readTable(file);
    if (merged.columns.empty()) {
      merged.head = table.head;
      merged.columns = table.columns;
    }
    if (table.columns != merged.columns) {
      throw Misuse(
          fmt::format("{}: its columns differ from those of {}", file.string(), folders.front()));
    }
    for (auto& row : table.rows) {
      const auto [at, added] = place.try_emplace(row.front(), merged.rows.size());
      if (added) {
        merged.rows.push_back(std::move(row));
      } else if (numberAt(table, row, "cpu_runs") > 0) {
        merged.rows[at->second] = std::move(row);
      }
    }
  }
  return merged;
}

}  // namespace irk
