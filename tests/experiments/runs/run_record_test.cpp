// From a record to a row, to a file and back: every number keeps its own name.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "experiments/runs/run_table.h"
#include "tests/experiments/other_spec.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

// A record in which all numbers differ.
RunRecord distinct() {
  RunRecord record;
  record.spec = sliderCrank();
  for (const auto& field : specFields()) {
    if (field.name == "configuration" || field.name == "scene") continue;
    field.set(record.spec, otherValues(field, record.spec).front());
  }
  record.family = "the_family";
  record.stages = 17;
  record.outcome = "success";
  record.detail = "a, \"detail\"";
  record.errors = {
      .all = 0.125, .u = 0.25, .v = 0.375, .x = 0.5, .z = 0.625, .mixed = 1e-3, .relative = 1e-2, .drift = 0.75};
  record.errors_over_time = {.all = 1.125, .u = 1.25, .v = 1.375, .x = 1.5, .z = 1.625, .drift = 1.75};
  Counters& c = record.counters;
  c.residuals = 101;
  c.dual_residuals = 102;
  c.jacobians = 103;
  c.factorizations = 104;
  c.mass_factorizations = 115;
  c.filter_factorizations = 116;
  c.solves = 105;
  c.filter_solves = 117;
  c.newton_iterations = 106;
  c.newton_restarts = 107;
  c.steps_accepted = 108;
  c.steps_rejected_error = 109;
  c.steps_rejected_newton = 110;
  c.switches = 111;
  c.discontinuous_iterations = 112;
  c.located_events = 113;
  c.chattering = 114;
  record.cpu_s = 0.875;
  return record;
}

Table writtenAndRead(const std::vector<TableRow>& rows) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "runs.csv";
  writeTable(file, {{}, runColumns(), rows});
  return readTable(file);
}

TEST(RunRow, HoldsEveryNumberUnderItsName) {
  const RunRecord record = distinct();
  const Table table = writtenAndRead({runRow("the_key", "the_study", record)});
  ASSERT_EQ(table.rows.size(), 1u);
  const TableRow& row = table.rows.front();
  ASSERT_EQ(row.size(), table.columns.size());
  const auto text = [&](const char* column) { return textAt(table, row, column); };
  EXPECT_EQ(text("key"), "the_key");
  EXPECT_EQ(text("study"), "the_study");
  EXPECT_EQ(text("family"), "the_family");
  EXPECT_EQ(text("stages"), "17");
  EXPECT_EQ(text("outcome"), "success");
  EXPECT_EQ(text("detail"), "a, \"detail\"");
  EXPECT_EQ(text("integrator"), integratorName(record.spec));
  const std::map<const char*, double> numbers = {{"error", 0.125},
                                                 {"error_u", 0.25},
                                                 {"error_v", 0.375},
                                                 {"error_x", 0.5},
                                                 {"error_z", 0.625},
                                                 {"drift", 0.75},
                                                 {"error_over_time", 1.125},
                                                 {"error_u_over_time", 1.25},
                                                 {"error_v_over_time", 1.375},
                                                 {"error_x_over_time", 1.5},
                                                 {"error_z_over_time", 1.625},
                                                 {"mescd", 3},
                                                 {"scd", 2},
                                                 {"residuals", 101},
                                                 {"dual_residuals", 102},
                                                 {"jacobians", 103},
                                                 {"factorizations", 104},
                                                 {"mass_factorizations", 115},
                                                 {"filter_factorizations", 116},
                                                 {"solves", 105},
                                                 {"filter_solves", 117},
                                                 {"newton_iterations", 106},
                                                 {"newton_restarts", 107},
                                                 {"steps_accepted", 108},
                                                 {"steps_rejected_error", 109},
                                                 {"steps_rejected_newton", 110},
                                                 {"switches", 111},
                                                 {"discontinuous_iterations", 112},
                                                 {"located_events", 113},
                                                 {"chattering", 114},
                                                 {"cpu_s", 0.875},
                                                 {"cpu_runs", 0}};
  for (const auto& [column, number] : numbers) {
    EXPECT_EQ(numberAt(table, row, column), number) << column;
  }
  EXPECT_TRUE(std::isnan(numberAt(table, row, "cpu_setup_s")));
  EXPECT_TRUE(std::isnan(numberAt(table, row, "cpu_median_s")));
  EXPECT_TRUE(std::isnan(numberAt(table, row, "cpu_spread")));
  for (const auto& field : specFields()) {
    if (!table.hasColumn(field.name)) continue;
    EXPECT_EQ(textAt(table, row, field.name), field.get(record.spec)) << field.name;
  }
}

TEST(RunRow, ColumnsAreNamedOnce) {
  const auto columns = runColumns();
  EXPECT_EQ(std::set<std::string>(columns.begin(), columns.end()).size(), columns.size());
}

TEST(RunRow, TimesGoToTheirColumns) {
  Table table{{}, runColumns(), {runRow("key", "study", distinct())}};
  setTiming(table, table.rows.front(), {0.25, 0.5, 2.5, {0.75, 0.25, 0.5}, 0.125});
  const TableRow& row = table.rows.front();
  EXPECT_EQ(numberAt(table, row, "cpu_s"), 0.25);
  EXPECT_EQ(numberAt(table, row, "cpu_setup_s"), 0.125);
  EXPECT_EQ(numberAt(table, row, "cpu_median_s"), 0.5);
  EXPECT_EQ(numberAt(table, row, "cpu_spread"), 2.5);
  EXPECT_EQ(numberAt(table, row, "cpu_runs"), 3);
  EXPECT_EQ(textAt(table, row, "cpu_all"), "0.75 0.25 0.5");
}

}  // namespace
}  // namespace irk
