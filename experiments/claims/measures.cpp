#include "experiments/claims/measures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <set>
#include <stdexcept>
#include <unordered_map>

#include "experiments/analyses/costs/cost_at_error.h"
#include "experiments/base/failure.h"
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

/// overTimes of rows that come one after another: keeps one row for all times of a run.
class OverTimes {
 public:
  explicit OverTimes(const Table& names) : names_{names.head, names.columns, {}} {
    for (const auto& field : specFields()) {
      if (field.name != "t_end" && names.hasColumn(field.name)) fields_.push_back(names.column(field.name));
    }
  }

  void add(TableRow row) {
    std::string text;
    for (const auto field : fields_) text.append(row[field]) += '\0';
    const auto [at, added] = places_.try_emplace(fnv1a(text), groups_.size());
    if (added) groups_.push_back({row, 0, {}});
    Group& group = groups_[at->second];
    const auto same = [&](std::size_t field) { return row[field] == group.last[field]; };
    if (!std::all_of(fields_.begin(), fields_.end(), same)) throw Failure("two runs of one table have the same hash");
    ++group.times;
    for (std::size_t i = 0; i < std::size(kErrorColumns); ++i) {
      if (!names_.hasColumn(kErrorColumns[i]) || !succeededAt(names_, row)) continue;
      const double error = errorAt(names_, row, kErrorColumns[i]);
      if (std::isnan(error)) continue;
      Largest& largest = group.errors[i];
      ++largest.known;
      if (!(largest.error >= error)) largest.error = error;
    }
    if (numberAt(names_, group.last, "t_end") < numberAt(names_, row, "t_end")) group.last = std::move(row);
  }

  // The runs with the last t_end, with the largest errors of all.
  Table result(std::string_view study) && {
    for (auto& group : groups_) {
      if (group.times < kReferenceTimes) continue;
      for (std::size_t i = 0; i < std::size(kErrorColumns); ++i) {
        if (!names_.hasColumn(kErrorColumns[i])) continue;
        const Largest& largest = group.errors[i];
        const double error = largest.known >= kReferenceTimes ? largest.error : kUnknown;
        group.last[names_.column(kErrorColumns[i])] = irk::numberText(error);
      }
      names_.rows.push_back(std::move(group.last));
    }
    if (!names_.rows.empty()) return std::move(names_);
    throw MissingResults(fmt::format("study {} lacks errors at {} reference times", study, kReferenceTimes));
  }

 private:
  struct Largest {
    double error = kUnknown;
    int known = 0;
  };
  struct Group {
    TableRow last;
    int times;
    Largest errors[std::size(kErrorColumns)];
  };
  Table names_;
  std::vector<std::size_t> fields_;  // all but t_end
  std::unordered_map<std::uint64_t, std::size_t> places_;
  std::vector<Group> groups_;
};

bool isOfSetting(const Table& names, const TableRow& row, Setting setting) {
  const auto& configuration = textAt(names, row, "configuration");
  return setting == Setting::kPaper ? configuration == "paper"
                                    : configuration == "embedded" || configuration == "variable";
}

[[noreturn]] void throwNoSetting(std::string_view study, Setting setting) {
  throw MissingResults(fmt::format("study {} lacks these runs with configuration '{}'", study,
                                   setting == Setting::kPaper ? "paper" : "embedded"));
}

// Calls take(names, row) for the runs of these blocks.
Table forEachInBlocks(const ResultTables& tables, std::string_view study, const Blocks& blocks,
                      const std::function<void(const Table& names, TableRow row)>& take) {
  for (const auto name : blocks) {
    if (!blocksOf(study).contains(std::string(name))) {
      throw std::logic_error(fmt::format("study {} has no block '{}'", study, name));
    }
  }
  const auto wanted = [&](const std::string& cell) {
    return std::any_of(blocks.begin(), blocks.end(), [&](auto name) { return hasBlock(cell, name); });
  };
  return tables.forEachRun(study, wanted, take);
}

// The runs of these blocks in a setting.
Table runsOf(const ResultTables& tables, std::string_view study, const Blocks& blocks, Setting setting) {
  std::vector<TableRow> rows;
  Table chosen = forEachInBlocks(tables, study, blocks, [&](const Table& names, TableRow row) {
    if (isOfSetting(names, row, setting)) rows.push_back(std::move(row));
  });
  if (rows.empty()) throwNoSetting(study, setting);
  chosen.rows = std::move(rows);
  return chosen;
}

// All blocks of the study claims whose names begin so.
Blocks claimBlocks(std::string_view beginning) {
  Blocks blocks;
  for (const auto& name : blocksOf("claims")) {
    if (name.starts_with(beginning)) blocks.push_back(name);
  }
  if (blocks.empty()) throw std::logic_error(fmt::format("study claims has no block '{}...'", beginning));
  return blocks;
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

Table inBlocks(const ResultTables& tables, std::string_view study, const Blocks& blocks) {
  std::vector<TableRow> rows;
  Table chosen =
      forEachInBlocks(tables, study, blocks, [&rows](const Table&, TableRow row) { rows.push_back(std::move(row)); });
  chosen.rows = std::move(rows);
  return chosen;
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
  Table chosen = where(table, [&](const TableRow& row) { return isOfSetting(table, row, setting); });
  if (chosen.rows.empty()) throwNoSetting(study, setting);
  return chosen;
}

Table overTimes(const Table& runs, std::string_view study) {
  OverTimes all(runs);
  for (const auto& run : runs.rows) all.add(run);
  return std::move(all).result(study);
}

Table timedRuns(const ResultTables& tables, std::string_view study, const Blocks& blocks, Setting setting) {
  std::optional<OverTimes> all;
  (void)forEachInBlocks(tables, study, blocks, [&](const Table& names, TableRow row) {
    if (!isOfSetting(names, row, setting)) return;
    if (!all) all.emplace(names);
    all->add(std::move(row));
  });
  if (!all) throwNoSetting(study, setting);
  return std::move(*all).result(study);
}

Table claimRuns(const ResultTables& tables, std::string_view beginning) {
  return inBlocks(tables, "claims", claimBlocks(beginning));
}

Table claimRuns(const ResultTables& tables, std::string_view beginning, Setting setting) {
  return runsOf(tables, "claims", claimBlocks(beginning), setting);
}

Table timedClaimRuns(const ResultTables& tables, std::string_view beginning, Setting setting) {
  return timedRuns(tables, "claims", claimBlocks(beginning), setting);
}

double evaluationsAt(const Table& runs, const TableRow& run) {
  return numberAt(runs, run, "residuals") + numberAt(runs, run, "dual_residuals");
}

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
