#include "experiments/claims/measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

#include "experiments/analyses/cost_at_error.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/block_names.h"
#include "experiments/study/study.h"
#include "experiments/study/study_reader.h"

namespace irk::claims {
namespace {

constexpr double kErrors[] = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10};
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

void requireBlock(std::string_view study, std::string_view name) {
  static std::map<std::string, std::set<std::string>, std::less<>> known;  // blocks of studies
  const auto [at, added] = known.try_emplace(std::string(study));
  if (added) {
    for (const auto& series : loadStudy(study, StudyVariant::kQuick).series) at->second.insert(series.block);
  }
  if (at->second.contains(std::string(name))) return;
  throw std::logic_error(fmt::format("study {} has no block '{}'", study, name));
}

void compareSeries(const Table& runs, const RunSeries& base, const RunSeries& other, std::string_view cost,
                   CostRatios& ratios) {
  for (const double error : kErrors) {
    const double a = seriesCostAtError(runs, base, cost, error);
    const double b = seriesCostAtError(runs, other, cost, error);
    if (std::isnan(a) && std::isnan(b)) continue;
    if (std::isnan(b)) {
      ++ratios.lost;
    } else if (std::isnan(a)) {
      ++ratios.won;
    } else {
      ratios.all.push_back(b / a);
    }
  }
}

}  // namespace

Table where(const Table& table, const std::function<bool(const TableRow&)>& test) {
  Table chosen{table.head, table.columns, {}};
  std::copy_if(table.rows.begin(), table.rows.end(), std::back_inserter(chosen.rows), test);
  return chosen;
}

Table where(const Table& table, const Cells& cells) {
  return where(table, [&](const TableRow& row) {
    return std::all_of(cells.begin(), cells.end(),
                       [&](const auto& cell) { return textAt(table, row, cell.first) == cell.second; });
  });
}

Table inBlocks(const Table& table, std::string_view study, const Blocks& blocks) {
  for (const auto name : blocks) requireBlock(study, name);
  const auto column = table.column(kBlockColumn);
  return where(table, [&](const TableRow& row) {
    return std::any_of(blocks.begin(), blocks.end(), [&](auto name) { return hasBlock(row[column], name); });
  });
}

std::vector<std::string> distinct(const Table& table, std::string_view column) {
  std::vector<std::string> cells;
  for (const auto& row : table.rows) {
    const auto& cell = textAt(table, row, column);
    if (std::find(cells.begin(), cells.end(), cell) == cells.end()) cells.push_back(cell);
  }
  return cells;
}

std::vector<double> numbersOf(const Table& table, std::string_view column) {
  std::vector<double> numbers;
  for (const auto& row : table.rows) {
    const double x = numberAt(table, row, column);
    if (!std::isnan(x)) numbers.push_back(x);
  }
  return numbers;
}

double leastCost(const Table& table, const std::function<bool(const TableRow&)>& test) {
  double least = kInfinity;
  for (const auto& row : table.rows) {
    if (test(row)) least = std::min(least, numberAt(table, row, "cpu_s"));
  }
  return least;
}

double part(const std::vector<double>& values, const std::function<bool(double)>& test) {
  if (values.empty()) return kUnknown;
  const auto count = std::count_if(values.begin(), values.end(), test);
  return static_cast<double>(count) / static_cast<double>(values.size());
}

std::string percent(double part) { return fmt::format("{:.3g} %", 100 * part); }

CostRatios compareCosts(const Table& runs, std::string_view column, std::string_view base, std::string_view other,
                        std::string_view cost) {
  const auto columns = seriesColumns(runs);
  const auto at = std::find(columns.begin(), columns.end(), column);
  if (at == columns.end()) return {};
  const auto place = static_cast<std::size_t>(at - columns.begin());
  const auto series = seriesOf(runs);
  std::map<TableRow, const RunSeries*> by_name;
  for (const auto& one : series) by_name[one.name] = &one;
  CostRatios ratios;
  for (const auto& one : series) {
    if (one.name[place] != base) continue;
    TableRow name = one.name;
    name[place] = other;
    const auto match = by_name.find(name);
    if (match != by_name.end()) compareSeries(runs, one, *match->second, cost, ratios);
  }
  return ratios;
}

std::span<const double> comparedErrors() { return kErrors; }

Verdict graded(double value, double good, double fair) {
  if (std::isnan(value)) return Verdict::kNotMeasurable;
  if (value <= good) return Verdict::kConfirmed;
  return value <= fair ? Verdict::kWithinLimits : Verdict::kContradicted;
}

Finding notMeasurable(std::string reason) { return {Verdict::kNotMeasurable, "–", std::move(reason)}; }

}  // namespace irk::claims
