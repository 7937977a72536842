#include "experiments/runs/run_table.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "experiments/base/numbers.h"
#include "experiments/runs/block_names.h"
#include "experiments/runs/fields.h"
#include "experiments/runs/own_files.h"
#include "experiments/tables/build_info.h"
#include "experiments/tables/environment.h"

namespace irk {
namespace {

// These fields stand before the derived columns; all others of specFields() follow them.
constexpr std::string_view kFirst[] = {"scene", "settings", "method"};
constexpr std::string_view kDerived[] = {"family", "stages", "integrator"};
constexpr std::string_view kAccuracy = "reference_accuracy";
constexpr std::string_view kInvariant = "invariant_change";
constexpr std::string_view kErrors[] = {"error",
                                        "error_u",
                                        "error_v",
                                        "error_x",
                                        "error_z",
                                        "error_t",
                                        "drift",
                                        kInvariant,
                                        "mescd",
                                        "scd",
                                        kAccuracy,
                                        "error_over_time",
                                        "error_u_over_time",
                                        "error_v_over_time",
                                        "error_x_over_time",
                                        "error_z_over_time",
                                        "error_bar",
                                        "error_bar_z",
                                        "error_bar_tolerances"};
constexpr std::string_view kTimes[] = {"cpu_s",    "cpu_setup_s", "cpu_median_s",    "cpu_spread",
                                       "cpu_runs", "cpu_all",     "cpu_environment", "cpu_error_bar_s"};
// The code that made a row, its machine and date, and the number of the last --fresh request for it.
constexpr std::string_view kOrigin[] = {"code", "environment", "date", "remade"};

void append(std::vector<std::string>& to, std::span<const std::string_view> names) {
  to.insert(to.end(), names.begin(), names.end());
}

bool isIn(std::span<const std::string_view> names, std::string_view name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

// How the run ended, why it has no error bar and no error, and what the bar may not show.
std::string detailOf(const RunRecord& record) {
  std::string all;
  for (const std::string* text : {&record.detail, &record.error_bar.told(), &record.errors.remark}) {
    if (!text->empty()) all += (all.empty() ? "" : "; ") + *text;
  }
  return all;
}

// The fields behind the derived columns, in the order of the columns.
std::vector<std::string_view> laterFields() {
  std::vector<std::string_view> names;
  for (const auto& field : specFields()) {
    if (!isIn(kFirst, field.name)) names.push_back(field.name);
  }
  return names;
}

// What setNotTimed adds to `detail`.
constexpr std::string_view kNotTimed = "not timed: ";
void forgetCause(std::string& detail) {
  const auto at = detail.find(kNotTimed);
  if (at != detail.npos) detail.erase(at < 2 ? 0 : at - 2);  // with "; "
}

}  // namespace

double largestChange(const std::vector<InvariantChange>& invariants) {
  constexpr double kRoundOff = 1e-9;
  double largest = std::numeric_limits<double>::quiet_NaN();
  for (const auto& one : invariants) {
    const double start = std::abs(one.start);
    const double change = start <= kRoundOff * one.change ? one.change : one.change / start;
    if (std::isnan(change)) return change;
    largest = std::fmax(largest, change);
  }
  return largest;
}

std::vector<std::string> runColumns() {
  std::vector<std::string> columns{"key", "study"};
  append(columns, kFirst);
  append(columns, kDerived);
  append(columns, laterFields());
  columns.insert(columns.end(), {"outcome", "t"});
  append(columns, kErrors);
  Counters{}.forEach([&](const char* name, std::int64_t) { columns.emplace_back(name); });
  append(columns, kTimes);
  columns.insert(columns.end(), {"detail", "files"});
  append(columns, kOrigin);
  return columns;
}

TableRow runRow(const std::string& key, const std::string& study, const RunRecord& record) {
  TableRow row{key, study};
  for (const auto name : kFirst) row.push_back(findField(name).get(record.spec));
  row.insert(row.end(), {record.family, std::to_string(record.stages), integratorName(record.spec)});
  for (const auto name : laterFields()) row.push_back(findField(name).get(record.spec));
  row.insert(row.end(), {record.outcome, numberText(record.t)});
  const RunErrors& e = record.errors;
  for (const double error :
       {e.all, e.u, e.v, e.x, e.z, e.t, e.drift, largestChange(record.invariants), e.mescd(), e.scd(), e.accuracy})
    row.push_back(numberText(error));
  const RunErrors& largest = record.errors_over_time;
  for (const double error : {largest.all, largest.u, largest.v, largest.x, largest.z}) row.push_back(numberText(error));
  for (const double error : {record.error_bar.error, record.error_bar.error_z, record.error_bar.tolerances})
    row.push_back(numberText(error));
  record.counters.forEach([&](const char*, std::int64_t count) { row.push_back(std::to_string(count)); });
  const std::string& environment = thisEnvironment().front();
  row.insert(row.end(),
             {numberText(record.cpu_s), "nan", "nan", "nan", "0", "", environment, numberText(record.error_bar.cpu_s),
              detailOf(record), filesOf(record.spec), std::string(buildInfo().code), environment, dateText(), ""});
  return row;
}

std::vector<std::string> seriesColumns(const Table& table) {
  std::vector<std::string> columns;
  append(columns, kFirst);
  append(columns, kDerived);
  append(columns, laterFields());
  for (const auto& field : specFields()) {
    if (field.swept) std::erase(columns, field.name);
  }
  std::erase_if(columns, [&](const auto& name) { return !table.hasColumn(name); });
  return columns;
}

std::vector<RunSeries> seriesOf(const Table& runs) {
  const auto columns = seriesColumns(runs);
  std::map<TableRow, std::size_t> place;
  std::vector<RunSeries> all;
  for (const auto& row : runs.rows) {
    TableRow name;
    for (const auto& column : columns) name.push_back(textAt(runs, row, column));
    const auto [at, added] = place.try_emplace(name, all.size());
    if (added) all.push_back({name, {}});
    all[at->second].rows.push_back(&row);
    if (runs.hasColumn(kBlockColumn)) addBlocks(all[at->second].blocks, textAt(runs, row, kBlockColumn));
  }
  return all;
}

void setTiming(const Table& table, TableRow& row, const Timing& timing) {
  forgetCause(row[table.column("detail")]);
  row[table.column("cpu_s")] = numberText(timing.minimum_s);
  row[table.column("cpu_setup_s")] = numberText(timing.setup_s);
  row[table.column("cpu_median_s")] = numberText(timing.median_s);
  row[table.column("cpu_spread")] = numberText(timing.spread);
  row[table.column("cpu_runs")] = std::to_string(timing.all_s.size());
  std::string all;
  for (const double seconds : timing.all_s) all += (all.empty() ? "" : " ") + numberText(seconds);
  row[table.column("cpu_all")] = all;
  row[table.column("cpu_environment")] = thisEnvironment().front();
  row[table.column("date")] = dateText();
}

void setNotTimed(const Table& table, TableRow& row, const std::string& cause) {
  auto& detail = row[table.column("detail")];
  forgetCause(detail);
  detail += (detail.empty() ? "" : "; ") + std::string(kNotTimed) + cause;
  row[table.column("date")] = dateText();
}

void forgetTiming(const Table& table, TableRow& row) {
  for (const char* name : {"cpu_s", "cpu_setup_s", "cpu_median_s", "cpu_spread"}) row[table.column(name)] = "nan";
  row[table.column("cpu_runs")] = "0";
  row[table.column("cpu_all")].clear();
}

double numberAt(const Table& table, const TableRow& row, std::string_view column) {
  return cellNumber(row[table.column(column)]);
}

const std::string& textAt(const Table& table, const TableRow& row, std::string_view column) {
  return row[table.column(column)];
}

bool succeededAt(const Table& table, const TableRow& row) {
  return textAt(table, row, "outcome") == name(Outcome::kSuccess);
}

bool hasFixedStepsAt(const Table& table, const TableRow& row) {
  return textAt(table, row, "control") == StepControl::kFixed.id;
}

bool notMeasurableAt(const Table& table, const TableRow& row) {
  return table.hasColumn(kAccuracy) && std::isnan(numberAt(table, row, "error")) &&
         !std::isnan(numberAt(table, row, kAccuracy));
}

double errorBoundAt(const Table& table, const TableRow& row) {
  const double over_time = table.hasColumn("error_over_time") ? numberAt(table, row, "error_over_time")
                                                              : std::numeric_limits<double>::quiet_NaN();
  if (!std::isnan(over_time)) return over_time;
  return notMeasurableAt(table, row) ? kMeasurable * numberAt(table, row, kAccuracy) : numberAt(table, row, "error");
}

}  // namespace irk
