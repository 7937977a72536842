#include "experiments/analyses/results.h"

#include <fstream>
#include <ostream>
#include <string>
#include <utility>

#include "experiments/analyses/cost_at_error.h"
#include "experiments/analyses/energy.h"
#include "experiments/analyses/estimates.h"
#include "experiments/analyses/orders.h"
#include "experiments/analyses/phases.h"
#include "experiments/analyses/profile.h"
#include "experiments/analyses/scaling.h"
#include "experiments/store/store.h"

namespace irk {

std::string refusedTimes(const TableHead& head) {
  for (const auto& [key, value] : head) {
    if (key == store::kTimesRefused) return value;
  }
  return {};
}

std::string refusedTimes(const std::filesystem::path& runs) {
  const auto start = "# " + std::string(store::kTimesRefused) + ": ";
  std::ifstream in(runs);
  for (std::string line; std::getline(in, line) && line.starts_with('#');) {
    if (line.starts_with(start)) return line.substr(start.size());
  }
  return {};
}

std::vector<std::string> writeSummaries(const Study& study, const Table& runs,
                                        const std::filesystem::path& folder,
                                        std::ostream& progress) {
  std::vector<std::string> doubts;
  const std::string refusal = refusedTimes(runs.head);
  if (!refusal.empty()) doubts.push_back(refusal);
  if (study.orders) writeTable(folder / "orders.csv", orderTable(runs));
  if (!study.targets.empty()) {
    const Table costs = costTable(runs, study.targets);
    writeTable(folder / "cpu_at_error.csv", costs);
    if (study.profile && refusal.empty()) writeTable(folder / "profile.csv", profileTable(costs));
    if (study.profile && !refusal.empty()) std::filesystem::remove(folder / "profile.csv");
  }
  if (study.estimates) writeTable(folder / "estimates.csv", estimateTable(study, runs));
  if (study.scaling) {
    const Table scaling = scalingTable(study, runs, progress);
    writeTable(folder / "scaling.csv", scaling);
    writeTable(folder / "scaling_slopes.csv", scalingSlopes(scaling));
  }
  if (study.energy) writeTable(folder / "energy.csv", energyTable(study, runs));
  if (!study.phases) return doubts;
  const Table phases = phaseTable(study, runs, progress);
  writeTable(folder / "phases.csv", phases);
  for (auto& line : uncoveredRuns(phases)) doubts.push_back(std::move(line));
  return doubts;
}

}  // namespace irk
