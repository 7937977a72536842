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
namespace {

using RowsByKey = std::map<std::string, const TableRow*>;

RowsByKey byKey(const Table& runs) {
  RowsByKey rows;
  for (const auto& row : runs.rows) rows[row.front()] = &row;
  return rows;
}

std::string runName(const Table& runs, const TableRow& row) {
  return fmt::format("{} {} {} h={} rtol={}", textAt(runs, row, "scene"),
                     textAt(runs, row, "settings"), textAt(runs, row, "method"),
                     textAt(runs, row, "h"), textAt(runs, row, "rtol"));
}

bool isComparable(const std::string& column) {
  return !column.starts_with("cpu_") && column != "detail";
}

int compareRow(const Table& runs, const TableRow& a, const TableRow& b, std::ostream& out) {
  int differences = 0;
  for (std::size_t i = 0; i < runs.columns.size(); ++i) {
    if (!isComparable(runs.columns[i]) || a[i] == b[i]) continue;
    ++differences;
    fmt::print(out, "{}: {} = {} and {}\n", runName(runs, a), runs.columns[i], a[i], b[i]);
  }
  return differences;
}

}  // namespace

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

int compareRuns(const Table& runs, const Table& other, std::ostream& out) {
  if (runs.columns != other.columns) throw Misuse("the two tables have different columns");
  const RowsByKey a = byKey(runs), b = byKey(other);
  int differences = 0, both = 0;
  double log_ratio = 0;
  for (const auto& [key, row] : a) {
    const auto match = b.find(key);
    if (match == b.end()) {
      ++differences;
      fmt::print(out, "{}: only in the first\n", runName(runs, *row));
      continue;
    }
    differences += compareRow(runs, *row, *match->second, out);
    const double ratio = numberAt(runs, *match->second, "cpu_s") / numberAt(runs, *row, "cpu_s");
    if (!(ratio > 0) || std::isinf(ratio)) continue;
    ++both;
    log_ratio += std::log(ratio);
  }
  for (const auto& [key, row] : b) {
    if (a.contains(key)) continue;
    ++differences;
    fmt::print(out, "{}: only in the second\n", runName(other, *row));
  }
  fmt::print(out, "{} runs and {} runs: {} differences", a.size(), b.size(), differences);
  if (both > 0) fmt::print(out, "; CPU time second / first: {:.3g}", std::exp(log_ratio / both));
  out << '\n';
  return differences;
}

}  // namespace irk
