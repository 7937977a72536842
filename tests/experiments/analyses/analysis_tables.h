// The tables of analyses, from a table of runs in memory.
#pragma once

#include <functional>
#include <iosfwd>
#include <vector>

#include "experiments/analyses/contractions.h"
#include "experiments/analyses/costs/cost_at_error.h"
#include "experiments/analyses/costs/profile.h"
#include "experiments/analyses/costs/ratios.h"
#include "experiments/analyses/costs/robustness.h"
#include "experiments/analyses/energy.h"
#include "experiments/analyses/estimates.h"
#include "experiments/analyses/orders/orders.h"
#include "experiments/analyses/parallel.h"
#include "experiments/analyses/phases.h"
#include "experiments/analyses/results.h"
#include "experiments/analyses/scaling.h"
#include "tests/experiments/support.h"

namespace irk {

/// What `read` makes of a file with these rows.
inline auto ofFile(const Table& table, const auto& read) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "table.csv";
  writeTable(file, table);
  return read(file);
}

/// The table that `write` writes.
inline Table writtenBy(const std::function<void(const std::filesystem::path&)>& write) {
  const TemporaryFolder folder;
  write(folder.path() / "written.csv");
  return readTable(folder.path() / "written.csv");
}

/// What `write` writes to a file about the runs.
inline Table analysisOf(const Table& runs,
                        const std::function<void(const RunFile&, const std::filesystem::path&)>& write) {
  return ofFile(runs, [&](const auto& file) { return writtenBy([&](const auto& to) { write(RunFile(file), to); }); });
}

inline Table orderTable(const Table& runs) { return analysisOf(runs, writeOrders); }
inline Table robustnessTable(const Table& runs) { return analysisOf(runs, writeRobustness); }
inline Table costTable(const Table& runs, const std::vector<double>& targets) {
  return analysisOf(runs, [&](const RunFile& from, const auto& to) { writeCosts(from, targets, to); });
}
inline Table ratioTable(const Table& runs, const std::vector<double>& targets) {
  return analysisOf(runs, [&](const RunFile& from, const auto& to) { writeRatios(from, targets, to); });
}
inline Table profileTable(const Table& costs) {
  return ofFile(costs, [](const auto& file) { return writtenBy([&](const auto& to) { writeProfile(file, to); }); });
}
inline Table estimateTable(const Study& study, const Table& runs) {
  return analysisOf(runs, [&](const RunFile& from, const auto& to) { writeEstimates(study, from, to); });
}
inline Table energyTable(const Study& study, const Table& runs) {
  return analysisOf(runs, [&](const RunFile& from, const auto& to) { writeEnergy(study, from, to); });
}
inline Table contractionTable(const Study& study, const Table& runs) {
  return analysisOf(runs, [&](const RunFile& from, const auto& to) { writeContractions(study, from, to); });
}
inline Table scalingTable(const Study& study, const Table& runs, std::ostream& progress) {
  return ofFile(runs, [&](const auto& file) { return scalingTable(study, RunFile(file), progress); });
}
inline Table parallelTable(const Study& study, const Table& runs, const std::vector<int>& processors,
                           std::ostream& progress) {
  return ofFile(runs, [&](const auto& file) { return parallelTable(study, RunFile(file), processors, progress); });
}
inline Table phaseTable(const Study& study, const Table& runs, std::ostream& progress) {
  return ofFile(runs, [&](const auto& file) { return phaseTable(study, RunFile(file), progress); });
}
inline void writeSummaries(const Study& study, const Table& runs, const std::filesystem::path& folder,
                           std::ostream& progress) {
  ofFile(runs, [&](const auto& file) { writeSummaries(study, RunFile(file), folder, progress); });
}

}  // namespace irk
