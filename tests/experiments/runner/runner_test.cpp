#include "experiments/runner/runner.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>

#include "experiments/compare/folders.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/study_reader.h"
#include "tests/experiments/analyses/analysis_tables.h"
#include "tests/experiments/compared_tables.h"
#include "tests/experiments/runner/timed_study.h"

namespace irk {
namespace {

constexpr char kSmallStudy[] = R"(
title = "Small"
orders = true
[[block]]
scene = "riccati_tracking"
families = ["radau_iia", "lobatto_iiib"]
stages = [2, 3]
refine_most = 40
[[block]]
scene = "pendulum"
t_end = 1
methods = ["radau_iia_2", "lobatto_iiib_3"]
tolerances = [1e-3, 1e-5]
)";

Study small() { return parseStudy(kSmallStudy, "small.toml", StudyVariant::kFull); }

RunnerOptions options(const TemporaryFolder& folder, int jobs) {
  RunnerOptions options;
  options.results = folder.path();
  options.jobs = jobs;
  return options;
}

TEST(Runner, OneAndTwoThreadsMakeTheSameRows) {
  const TemporaryFolder one, two;
  std::ostringstream quiet;
  const Table a = runStudy(small(), options(one, 1), quiet);
  const Table b = runStudy(small(), options(two, 2), quiet);
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t i = 0; i < a.rows.size(); ++i) {
    for (std::size_t c = 0; c < a.columns.size(); ++c) {
      if (a.columns[c] == "cpu_s" || a.columns[c] == "date") continue;
      EXPECT_EQ(a.rows[i][c], b.rows[i][c]) << "row " << i << ", " << a.columns[c];
    }
  }
}

TEST(Runner, MisuseInsideASweepIsARow) {
  const Table runs = runsOf(kSmallStudy).runs;
  int refused = 0;
  for (const auto& row : runs.rows) {
    if (textAt(runs, row, "outcome") != "refused") continue;
    ++refused;
    EXPECT_EQ(textAt(runs, row, "method"), "lobatto_iiib_3");
    EXPECT_EQ(textAt(runs, row, "stages"), "3");
    EXPECT_TRUE(containsAll(textAt(runs, row, "detail"), {"lobatto_iiib_3", "algebraic"}));
  }
  EXPECT_EQ(refused, 2);
}

TEST(Runner, FinishedRunsAreNotMadeAgain) {
  const TemporaryFolder folder;
  std::ostringstream quiet;
  const Table first = runStudy(small(), options(folder, 2), quiet);
  const auto parts = partsOf(folder.path() / "small");
  ASSERT_EQ(parts.size(), 1u);
  // A mark on a row shows whether its run was made again; a lost row must be.
  Table part = readPartTable(parts.front());
  const std::size_t cpu = part.column("cpu_s");
  for (auto& row : part.rows) row[cpu] = "12345";
  const TableRow lost = part.rows.back();
  part.rows.pop_back();
  writePartTable(parts.front(), part);
  std::ofstream(parts.front(), std::ios::app) << csvLine(lost).substr(0, 30);  // killed while writing

  std::ostringstream told;
  const Table again = runStudy(small(), options(folder, 2), told);
  EXPECT_TRUE(containsAll(told.str(), {parts.front().filename(), "1 rows cannot be read", ".damaged"}));
  ASSERT_EQ(again.rows.size(), first.rows.size());
  for (std::size_t i = 0; i < again.rows.size(); ++i) {
    EXPECT_EQ(again.rows[i].front(), first.rows[i].front());
    EXPECT_EQ(again.rows[i][cpu] != "12345", again.rows[i].front() == lost.front());
  }
  RunnerOptions fresh = options(folder, 2);
  fresh.store.finished = store::FinishedRuns::kRunAgain;
  for (const auto& row : runStudy(small(), fresh, quiet).rows) EXPECT_NE(row[cpu], "12345");
}

TEST(Runner, ShardsTogetherAreTheWhole) {
  const TemporaryFolder folder;
  std::ostringstream quiet;
  std::vector<std::string> parts;
  for (int i = 1; i <= 3; ++i) {
    RunnerOptions part = options(folder, 1);
    part.shard = parseShard(std::to_string(i) + "/3");
    runStudy(small(), part, quiet);
    parts.push_back(studyFolder(small(), part));
  }
  store::Store joined(folder.path() / "joined", "small", store::Use::kWrite, {}, quiet);
  for (const auto& part : parts) {
    joined.takeOver(store::Store(part, "", store::Use::kRead, {}, quiet));
  }
  joined.exportTables(runKeys(small(), {}));
  const Table merged = readTable(folder.path() / "joined" / "runs.csv");
  const Table whole = runStudy(small(), options(folder, 1), quiet);
  const auto comparison = compared(whole, merged, {.times = 10});
  EXPECT_TRUE(comparison.differences.empty()) << compare::textOf("", comparison);
}

TEST(Runner, OrdersOfTheSweepAgreeWithTheory) {
  const Table orders = orderTable(runsOf(kSmallStudy).runs);
  ASSERT_EQ(orders.rows.size(), 4u);
  for (const auto& row : orders.rows) {
    EXPECT_EQ(textAt(orders, row, "component"), "x");
    EXPECT_EQ(textAt(orders, row, "verdict"), "agrees")
        << textAt(orders, row, "family") << " " << textAt(orders, row, "stages") << ": " << textAt(orders, row, "order")
        << " " << textAt(orders, row, "reason");
  }
}

// The observed orders of a block.
Table ordersOf(const std::string& block) { return orderTable(runsOf("orders = true\n[[block]]" + block).runs); }

// Each row has the order that `expected` says of it, NaN for any, and agrees with theory.
void expectOrders(const Table& orders, std::size_t rows, double tolerance,
                  const std::function<double(const TableRow&)>& expected) {
  ASSERT_EQ(orders.rows.size(), rows);
  for (const auto& row : orders.rows) {
    const double order = expected(row);
    if (std::isnan(order)) continue;
    EXPECT_NEAR(numberAt(orders, row, "order"), order, tolerance) << csvLine(row);
    EXPECT_EQ(textAt(orders, row, "verdict"), "agrees") << csvLine(row);
  }
}

// Orders 40 and 39, from t_end / N with N = 18 to 36 and errors from 1e-86 to 1e-98. orderTolerance is 0.4 there, so
// a difference of one order is detected.
TEST(Runner, OrdersOfTwentyStagesInHundredDigits) {
  const Table orders = ordersOf(R"(
scene = "riccati_tracking"
scalar = "mp100"
methods = ["gauss_20", "radau_iia_20"]
refine_most = 40
)");
  expectOrders(orders, 2, 0.5, [&](const TableRow& row) { return textAt(orders, row, "family") == "gauss" ? 40 : 39; });
}

// The complete chain in 50 digits: planner, runs, fit, theory. Gauss in index 2 and 3 loses order in every component
// but q, diverges in lambda, and regains its order by projection.
TEST(Runner, OrdersOfAMechanicalSystemInFiftyDigits) {
  const Table orders = ordersOf(R"(
scene = "mechanical_dae"
scalar = "mp50"
multipliers = "stages"
formulation = ["index2", "index3", "index2_projected"]
methods = ["gauss_2", "radau_iia_2"]
refine_most = 128
)");
  const std::map<std::string, std::array<double, 3>> expected = {{"index2 gauss", {4, 2, 0}},
                                                                 {"index2 radau_iia", {3, 3, 2}},
                                                                 {"index3 gauss", {2, 0, -2}},
                                                                 {"index3 radau_iia", {3, 2, 1}},
                                                                 {"index2_projected gauss", {4, 4, NAN}},
                                                                 {"index2_projected radau_iia", {3, 3, 2}}};
  expectOrders(orders, 18, 0.15, [&](const TableRow& row) {
    const auto name = textAt(orders, row, "formulation") + " " + textAt(orders, row, "family");
    return expected.at(name).at(std::string("uvz").find(textAt(orders, row, "component")));
  });
}

// Where z has order 0 it jumps between steps, and simplified Newton fails in 50 digits. The study therefore uses
// modified Newton there, and the measured orders are those of theory.
TEST(Runner, TheOrderStudyMeasuresIndex2WithFewStages) {
  Study study = loadStudy("order", StudyVariant::kFull);
  std::vector<Series> few(study.series.begin(), study.series.end());
  std::erase_if(few, [](const Series& series) {
    const RunSpec& spec = series.runs.front();
    return spec.scene != "index2_nonlinear" || (spec.method != "gauss_1" && spec.method != "lobatto_iiid_2");
  });
  study.series = few;
  ASSERT_EQ(study.series.size(), 2u);
  const TemporaryFolder folder;
  std::ostringstream quiet;
  const Table orders = orderTable(runStudy(study, options(folder, 2), quiet));
  expectOrders(orders, 4, 0.1, [&](const TableRow& row) { return textAt(orders, row, "component") == "x" ? 2 : 0; });
}

// A lambda that is solved again at the end has the order of v, in the measurement and in the theoretical table.
TEST(Runner, OrdersOfConsistentMultipliers) {
  const Table orders = ordersOf(R"(
scene = "mechanical_dae"
scalar = "mp50"
formulation = ["index2", "index3"]
multipliers = ["stages", "consistent"]
methods = "radau_iia_2"
refine_most = 128
)");
  expectOrders(orders, 12, 0.15, [&](const TableRow& row) -> double {
    if (textAt(orders, row, "component") != "z") return NAN;
    const int v = textAt(orders, row, "formulation") == "index2" ? 3 : 2;
    return textAt(orders, row, "multipliers") == "consistent" ? v : v - 1;
  });
}

// The planner of steps divides an interval that ends before the start.
TEST(Runner, OrdersBackwardInTime) {
  const Table orders = ordersOf(R"(
scene = "riccati_tracking"
scalar = "mp50"
t_end = [1, -1]
methods = ["gauss_2", "radau_iia_2"]
refine_most = 64
)");
  expectOrders(orders, 4, 0.15, [&](const TableRow& row) { return textAt(orders, row, "family") == "gauss" ? 4 : 3; });
}

// With z = h lambda fixed: error = C h^3 / z for Radau IIA with two stages.
TEST(Runner, PowersOfTheStepAndOfTheStiffness) {
  const Table orders = ordersOf(R"(
scene = "prothero_robinson"
scalar = "mp50"
settings = ["lambda=-1e6/h", "lambda=-1e8/h", "lambda=-1e10/h"]
methods = "radau_iia_2"
refine_most = 64
)");
  expectOrders(orders, 4, 0.15, [&](const TableRow& row) { return textAt(orders, row, "power_of") == "z" ? -1 : 3; });
  EXPECT_EQ(textAt(orders, orders.rows.back(), "power_of"), "z");
}

TEST(Timing, TimesSuccessfulRunsOnce) {
  TimedStudy timed(kSmallStudy);
  timed.study.timing = {true, 1e-4, 3, 0.5, 3};
  const Table read = timed.time();
  for (const auto& row : read.rows) {
    const double repetitions = numberAt(read, row, "cpu_runs");
    if (!succeededAt(read, row)) {
      EXPECT_EQ(repetitions, 0);
      continue;
    }
    EXPECT_EQ(repetitions, 3);
    EXPECT_GT(numberAt(read, row, "cpu_s"), 0);
    EXPECT_GE(numberAt(read, row, "cpu_median_s"), numberAt(read, row, "cpu_s"));
    EXPECT_GE(numberAt(read, row, "cpu_spread"), 0);
  }
  // A second pass has nothing to time. With more repetitions only the missing ones are measured.
  EXPECT_EQ(timed.time().rows, read.rows);
  timed.study.timing.repetitions = 5;
  const Table again = timed.time();
  ASSERT_EQ(again.rows.size(), read.rows.size());
  const auto all = read.column("cpu_all");
  for (std::size_t i = 0; i < again.rows.size(); ++i) {
    const TableRow &row = again.rows[i], &before = read.rows[i];
    EXPECT_EQ(row.front(), before.front());
    EXPECT_EQ(numberAt(again, row, "cpu_runs"), succeededAt(again, row) ? 5 : 0);
    EXPECT_EQ(row[all].starts_with(before[all] + " "), succeededAt(again, row)) << row[all];
  }
}

}  // namespace
}  // namespace irk
