// Exports tables from the rows of a store.
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "experiments/runs/block_names.h"
#include "experiments/runs/run_table.h"
#include "experiments/store/calibration.h"
#include "experiments/store/facts.h"
#include "experiments/store/store.h"
#include "experiments/tables/build_info.h"
#include "experiments/tables/environment.h"
#include "experiments/tables/table_rows.h"

namespace irk::store {
namespace {

std::string joined(const std::set<std::string>& texts) { return fmt::format("{}", fmt::join(texts, " | ")); }

std::string textOf(std::uint32_t seconds) { return fmt::format("{:%FT%TZ}", fmt::gmtime(std::time_t{seconds})); }

}  // namespace

// The origins of a table's rows: codes, environments, processors.
struct Store::Origins {
  struct Measured {
    std::size_t rows = 0;
    std::set<std::string> environments;
  };
  std::map<std::uint16_t, std::size_t> codes, environments;  // rows of each
  std::uint32_t first_date = ~0u, last_date = 0;
  std::set<std::string> machines;
  std::map<std::string, std::map<std::string, Measured>> measured;  // by library and timing class

  // The reason why their times are not joined; empty if they are.
  std::string refusalOfTimes() const {
    std::size_t count = 0;
    std::string text;
    for (const auto& [library, classes] : measured) {
      if (machines.size() < 2 && classes.size() < 2) continue;
      count += classes.size();
      for (const auto& [name, its] : classes) {
        text += fmt::format(" '{}' ({} rows, environments {}),", name, its.rows, fmt::join(its.environments, " "));
      }
    }
    if (count == 0) return {};
    return fmt::format("times of {} timing classes (processor, compiler, flags, libraries) are not joined:", count) +
           text +
           " so runs.csv has none. Either --times here, which keeps those of this one and measures the others "
           "again if the study has a timing pass, or --fresh";
  }
};

Store::Origins Store::originsOf(const RunKeys& keys) const {
  Origins origins;
  TimingClasses classes(runs_, environments_);
  forEachRun(keys, [&](const Entry& entry, const std::string&) {
    ++origins.codes[entry.code];
    ++origins.environments[entry.environment];
    origins.first_date = std::min(origins.first_date, entry.date);
    origins.last_date = std::max(origins.last_date, entry.date);
    if (runs_.name(entry.outcome) != name(Outcome::kSuccess)) return;
    if (options_.times == Times::kHere && !timedHere(entry)) return;
    const RowClass& of = classes.of(entry);
    origins.machines.insert(of.machine);
    auto& here = origins.measured[of.library][of.name];
    ++here.rows;
    here.environments.insert(runs_.name(entry.cpu_environment));
  });
  return origins;
}

TableHead Store::head(const Origins& origins, const std::string& refusal) const {
  TableHead head{{"study", study_}};
  std::string made_by;
  for (const auto& [code, rows] : origins.codes) {
    const bool current = runs_.name(code) == buildInfo().code;
    made_by +=
        fmt::format("{}{} ({} rows{})", made_by.empty() ? "" : ", ", runs_.name(code), rows, current ? "" : ", stale");
  }
  head.emplace_back("code", made_by);
  const auto columns = environmentColumns();
  for (const char* name : {"version", "commit", "host", "compiler", "flags", "libraries", "cpu"}) {
    const auto at = static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin());
    std::set<std::string> values;
    for (const auto& [environment, rows] : origins.environments) {
      const auto entry = environments_.find(keyNumber(runs_.name(environment)));
      values.insert(entry ? environments_.row(*entry)[at] : "unknown");
    }
    head.emplace_back(name, joined(values));
  }
  const auto first = origins.first_date, last = origins.last_date;
  if (last > 0)
    head.emplace_back("date", first == last ? textOf(last) : fmt::format("{} to {}", textOf(first), textOf(last)));
  if (folder_.parent_path().filename() == "quick")
    head.emplace_back("quick", "a small version of the study; preliminary");
  if (!refusal.empty()) head.emplace_back(kTimesRefused, refusal);
  const auto drift = calibrationDoubts(calibrationsByHost(calibrations_, environments_));
  if (!drift.empty()) head.emplace_back(kTimesDrift, drift);
  const auto cores = takenCores(timing_cores_, environments_);
  if (!cores.empty()) head.emplace_back(kTimingCores, cores);
  return head;
}

void Store::exportRuns(const RunKeys& keys, const TableHead& head, bool times_refused) const {
  const Table names{{}, runs_.columns(), {}};
  auto columns = runs_.columns();
  if (keys.hasBlocks()) columns.emplace_back(kBlockColumn);
  TableWriter table(folder_ / "runs.csv", head, columns);
  forEachRun(keys, [&](const Entry& entry, const std::string& blocks) {
    const bool times_count = !times_refused && (options_.times == Times::kAll || timedHere(entry));
    std::string line;
    if (times_count) {
      line = runs_.csv(entry);
    } else {
      TableRow row = runs_.row(entry);
      forgetTiming(names, row);
      line = csvLine(row);
    }
    if (keys.hasBlocks()) line += ',' + csvLine({blocks});
    table.addLine(line);
  });
  table.close();
}

void Store::exportStates(const RunKeys& keys) const {
  TableWriter table(folder_ / "states.csv", {{"study", study_}}, states_.columns());
  keys.forEach([&](std::uint64_t key, const std::string&) {
    if (const auto entry = states_.find(key)) table.addLine(states_.csv(*entry));
  });
  table.close();
}

void Store::exportAll(const Rows& rows) const {
  TableWriter table(folder_ / (rows.kind() + ".csv"), {{"study", study_}}, rows.columns());
  rows.forEach([&](const Entry& entry) { table.addLine(rows.csv(entry)); });
  table.close();
}

std::string Store::exportTables(const RunKeys& keys) const {
  const Origins origins = originsOf(keys);
  std::string refusal = origins.refusalOfTimes();
  exportRuns(keys, head(origins, refusal), !refusal.empty());
  exportAll(environments_);
  if (calibrations_.size() > 0) exportAll(calibrations_);
  if (timing_cores_.size() > 0) exportAll(timing_cores_);
  if (states_.size() > 0) exportStates(keys);
  return refusal;
}

}  // namespace irk::store
