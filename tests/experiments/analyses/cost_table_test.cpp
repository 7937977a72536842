// The runs of a series, and their costs, from synthetic rows with a different number in every column.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "experiments/analyses/costs/cost_at_error.h"
#include "experiments/runs/run_table.h"
#include "experiments/study/study_reader.h"
#include "tests/experiments/analyses/analysis_tables.h"
#include "tests/experiments/study_runs.h"

namespace irk {
namespace {

TEST(CostTable, TakesEachCostFromItsColumnAndSuccessesOnly) {
  Table runs;
  runs.columns = {"scene",     "method",        "newton", "outcome", "error", "cpu_s", "residuals", "newton_iterations",
                  "jacobians", "factorizations"};
  const auto add = [&](const char* method, const char* outcome, double error, double cost) {
    TableRow row{"pendulum", method, "full", outcome, fmt::format("{}", error)};
    for (const double factor : {1.0, 100.0, 10.0, 2.0, 3.0}) row.push_back(fmt::format("{}", factor * cost));
    runs.rows.push_back(row);
  };
  add("gauss_2", "success", 1e-2, 1);
  add("gauss_2", "success", 1e-4, 4);
  add("gauss_2", "max_steps", 1e-5, 0.001);  // cheap and accurate, but no success
  add("gauss_3", "success", 1e-6, 7);
  const Table costs = costTable(runs, {1e-4, 1e-5});
  ASSERT_EQ(costs.rows.size(), 4u);
  const auto expect = [&](std::size_t i, const char* method, double target, double cost) {
    const auto& row = costs.rows[i];
    EXPECT_EQ(textAt(costs, row, "method"), method);
    EXPECT_EQ(numberAt(costs, row, "target_error"), target);
    EXPECT_EQ(textAt(costs, row, "reached"), std::isnan(cost) ? "0" : "1");
    if (std::isnan(cost)) {
      EXPECT_TRUE(std::isnan(numberAt(costs, row, "cpu_s")));
      return;
    }
    EXPECT_NEAR(numberAt(costs, row, "cpu_s"), cost, 1e-12);
    EXPECT_NEAR(numberAt(costs, row, "residuals"), 100 * cost, 1e-10);
    EXPECT_NEAR(numberAt(costs, row, "newton_iterations"), 10 * cost, 1e-10);
    EXPECT_NEAR(numberAt(costs, row, "jacobians"), 2 * cost, 1e-12);
    EXPECT_NEAR(numberAt(costs, row, "factorizations"), 3 * cost, 1e-12);
  };
  expect(0, "gauss_2", 1e-4, 4);
  expect(1, "gauss_2", 1e-5, NAN);
  expect(2, "gauss_3", 1e-4, 7);
  expect(3, "gauss_3", 1e-5, 7);
}

// After two runs in a row with too many steps harder ones are skipped, unless all runs are requested.
TEST(SeriesEnds, DecideWhichRunsAreMade) {
  Study study = parseStudy(R"(
[[block]]
scene = "kepler"
methods = "radau_iia_2"
tolerances = [1e-2, 1e-6, 1e-8, 1e-10]
max_steps = 40
)",
                           "small.toml", StudyVariant::kFull);
  ASSERT_EQ(study.series.size(), 1u);
  const auto made = [&](SeriesEnd end) {
    const TemporaryFolder folder;
    Series changed = study.series.front();
    changed.end = end;
    study.series = std::vector{changed};
    RunnerOptions options;
    options.results = folder.path();
    options.jobs = 1;
    std::ostringstream quiet;
    const Table runs = runStudy(study, options, quiet);
    EXPECT_EQ(runs.rows.size(), 4u);
    int count = 0;
    for (const auto& row : runs.rows) count += numberAt(runs, row, "residuals") > 0 ? 1 : 0;
    for (std::size_t i = 0; i < runs.rows.size(); ++i) {
      EXPECT_EQ(textAt(runs, runs.rows[i], "outcome"), "max_steps");
    }
    return count;
  };
  EXPECT_EQ(made(SeriesEnd::kAll), 4);
  EXPECT_EQ(made(SeriesEnd::kTooLong), 2);
}

}  // namespace
}  // namespace irk
