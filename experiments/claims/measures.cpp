#include "experiments/claims/measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>
#include <stdexcept>

#include "experiments/analyses/costs/cost_at_error.h"
#include "experiments/base/numbers.h"
#include "experiments/runs/block_names.h"
#include "experiments/runs/fields.h"
#include "experiments/study/study.h"
#include "experiments/study/study_reader.h"

namespace irk::claims {
namespace {

constexpr double kErrors[] = {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};
constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::string_view kErrorColumns[] = {"error", "error_u", "error_v", "error_x", "error_z"};

const std::set<std::string>& blocksOf(std::string_view study) {
  static std::map<std::string, std::set<std::string>, std::less<>> known;
  const auto [at, added] = known.try_emplace(std::string(study));
  if (added) {
    for (const auto& series : loadStudy(study, StudyVariant::kQuick).series) at->second.insert(series.block);
  }
  return at->second;
}

double errorAt(const Table& runs, const TableRow& run, std::string_view column) {
  return column == "error" ? errorBoundAt(runs, run) : numberAt(runs, run, column);
}

// The columns of all fields of a run but t_end.
std::vector<std::size_t> columnsButEnd(const Table& runs) {
  std::vector<std::size_t> columns;
  for (const auto& field : specFields()) {
    if (field.name != "t_end" && runs.hasColumn(field.name)) columns.push_back(runs.column(field.name));
  }
  return columns;
}

// Joins runs to several times: the run with the last t_end, with the largest errors of all.
TableRow joined(const Table& runs, const std::vector<const TableRow*>& times) {
  const auto last = std::max_element(times.begin(), times.end(), [&](auto* a, auto* b) {
    return numberAt(runs, *a, "t_end") < numberAt(runs, *b, "t_end");
  });
  TableRow row = **last;
  for (const auto column : kErrorColumns) {
    if (!runs.hasColumn(column)) continue;
    double largest = kUnknown;
    int known = 0;
    for (const auto* run : times) {
      const double error = errorAt(runs, *run, column);
      if (std::isnan(error) || !succeededAt(runs, *run)) continue;
      ++known;
      if (!(largest >= error)) largest = error;
    }
    row[runs.column(column)] = irk::numberText(known >= kReferenceTimes ? largest : kUnknown);
  }
  return row;
}

void compareSeries(const Table& runs, const RunSeries& base, const RunSeries& other, std::string_view cost,
                   CostRatios& ratios) {
  for (const double error : kErrors) {
    const double a = seriesCost(runs, base, cost, "error", error);
    const double b = seriesCost(runs, other, cost, "error", error);
    if (std::isnan(a) && std::isnan(b)) continue;
    if (std::isnan(b)) {
      ++ratios.lost;
    } else if (std::isnan(a)) {
      ++ratios.won;
    } else {
      ratios.cases.push_back({textAt(runs, *base.rows.front(), "scene"), b / a});
    }
  }
}

TableRow placeOf(const Table& runs, const RunSeries& series, const std::vector<std::string_view>& also) {
  const TableRow& run = *series.rows.front();
  TableRow place{textAt(runs, run, "scene")};
  if (runs.hasColumn("settings")) place.push_back(textAt(runs, run, "settings"));
  for (const auto column : also) place.push_back(textAt(runs, run, column));
  return place;
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
  for (const auto name : blocks) {
    if (!blocksOf(study).contains(std::string(name))) {
      throw std::logic_error(fmt::format("study {} has no block '{}'", study, name));
    }
  }
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

Table inSetting(const Table& table, std::string_view study, Setting setting) {
  Table chosen = where(table, [&](const TableRow& row) {
    const auto& configuration = textAt(table, row, "configuration");
    return setting == Setting::kPaper ? configuration == "paper"
                                      : configuration == "embedded" || configuration == "variable";
  });
  if (!chosen.rows.empty()) return chosen;
  throw MissingResults(fmt::format("study {} lacks these runs with configuration '{}'", study,
                                   setting == Setting::kPaper ? "paper" : "embedded"));
}

Table overTimes(const Table& runs, std::string_view study) {
  std::map<TableRow, std::size_t> place;
  std::vector<std::vector<const TableRow*>> groups;
  const auto columns = columnsButEnd(runs);
  for (const auto& run : runs.rows) {
    TableRow key;
    for (const auto column : columns) key.push_back(run[column]);
    const auto [at, added] = place.try_emplace(std::move(key), groups.size());
    if (added) groups.emplace_back();
    groups[at->second].push_back(&run);
  }
  Table all{runs.head, runs.columns, {}};
  for (const auto& times : groups) {
    if (times.size() >= kReferenceTimes) all.rows.push_back(joined(runs, times));
  }
  if (!all.rows.empty()) return all;
  throw MissingResults(fmt::format("study {} lacks errors at {} reference times", study, kReferenceTimes));
}

Table timedRuns(const ResultTables& tables, std::string_view study, const Blocks& blocks, Setting setting) {
  return overTimes(inSetting(inBlocks(tables.runs(study), study, blocks), study, setting), study);
}

Table claimRuns(const ResultTables& tables, std::string_view beginning) {
  const Table& runs = tables.runs("claims");
  Blocks blocks;
  for (const auto& name : blocksOf("claims")) {
    if (name.starts_with(beginning)) blocks.push_back(name);
  }
  if (blocks.empty()) throw std::logic_error(fmt::format("study claims has no block '{}...'", beginning));
  return inBlocks(runs, "claims", blocks);
}

Table claimRuns(const ResultTables& tables, std::string_view beginning, Setting setting) {
  return inSetting(claimRuns(tables, beginning), "claims", setting);
}

Table timedClaimRuns(const ResultTables& tables, std::string_view beginning, Setting setting) {
  return overTimes(claimRuns(tables, beginning, setting), "claims");
}

std::string percent(double part) { return fmt::format("{:.3g} %", 100 * part); }

std::span<const double> comparedErrors() { return kErrors; }

double seriesCost(const Table& runs, const RunSeries& series, std::string_view cost, std::string_view error,
                  double target) {
  std::vector<CostPoint> points;
  for (const auto* run : series.rows) {
    if (succeededAt(runs, *run)) points.push_back({errorAt(runs, *run, error), numberAt(runs, *run, cost)});
  }
  return costAtError(std::move(points), target);
}

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

double Race::least(const std::function<bool(const TableRow& run)>& test) const {
  double least = kInfinity;
  for (const auto& [series, cost] : costs) {
    if (test(*series->rows.front())) least = std::min(least, cost);
  }
  return least;
}

std::vector<Race> races(const Table& runs, const std::vector<RunSeries>& series, std::string_view error_column,
                        const std::vector<std::string_view>& also) {
  std::map<std::pair<TableRow, double>, Race> all;
  for (const auto& one : series) {
    const TableRow place = placeOf(runs, one, also);
    for (const double error : kErrors) {
      const double cost = seriesCost(runs, one, "cpu_s", error_column, error);
      if (std::isnan(cost)) continue;
      const auto at = all.try_emplace({place, error}, Race{place.front(), error, {}}).first;
      at->second.costs.emplace_back(&one, cost);
    }
  }
  std::vector<Race> list;
  for (auto& [place, race] : all) list.push_back(std::move(race));
  return list;
}

std::vector<Race> atSmallestError(const Table& runs, const std::vector<RunSeries>& series, std::size_t competitors,
                                  const std::vector<std::string_view>& also) {
  std::map<TableRow, Race> smallest;
  for (auto& race : races(runs, series, "error", also)) {
    if (race.costs.size() < competitors) continue;
    const TableRow place = placeOf(runs, *race.costs.front().first, also);
    const auto [at, added] = smallest.try_emplace(place, race);
    if (!added && race.error < at->second.error) at->second = std::move(race);
  }
  std::vector<Race> list;
  for (auto& [place, race] : smallest) list.push_back(std::move(race));
  return list;
}

}  // namespace irk::claims
