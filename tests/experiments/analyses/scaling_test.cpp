#include "experiments/analyses/scaling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <tuple>

#include "experiments/base/numbers.h"
#include "experiments/runs/run_table.h"
#include "tests/experiments/analyses/analysis_tables.h"
#include "tests/experiments/study_runs.h"

namespace irk {
namespace {

// A synthetic table: the time grows with n^1.5 and s^2, and n = 10 lies off the line. The clock on the wall of one
// thread, and the CPU clock of one of several, show something else.
TEST(Scaling, SlopesOverUnknownsAndStages) {
  Table table;
  table.columns = {"scene",  "formulation", "solver", "storage", "threads",
                   "method", "stages",      "n",      "step_s",  "step_cpu_s"};
  for (const double s : {2.0, 4.0, 8.0}) {
    for (const double n : {10.0, 200.0, 800.0, 3200.0}) {
      const double time = n < 100 ? 1 : 1e-6 * std::pow(n, 1.5) * s * s;
      for (const auto& [threads, wall, cpu] : {std::tuple("1", n, time), std::tuple("2", time, 1 / n)}) {
        table.rows.push_back({"beam", "index2", "schur", "sparse", threads, "radau_iia_" + numberText(s), numberText(s),
                              numberText(n), numberText(wall), numberText(cpu)});
      }
    }
  }
  const Table slopes = scalingSlopes(table);
  int over_n = 0, over_stages = 0;
  for (const auto& row : slopes.rows) {
    const bool n = textAt(slopes, row, "over") == "n";
    if (!n && textAt(slopes, row, "at") == "10") continue;  // the same time for all s
    EXPECT_NEAR(numberAt(slopes, row, "slope"), n ? 1.5 : 2.0, 1e-9);
    EXPECT_EQ(textAt(slopes, row, "points"), "3");
    ++(n ? over_n : over_stages);
  }
  EXPECT_EQ(over_n, 2 * 3);
  EXPECT_EQ(over_stages, 2 * 3);
}

TEST(Scaling, StepsOfASparseSystem) {
  const auto [study, runs] = runsOf(R"(
scaling = true
[[block]]
scene = "beam_chain"
settings = ["m=50", "m=100"]
storage = "sparse"
methods = "radau_iia_3"
steps = [1e-4]
t_end = 1e-3
)");
  std::ostringstream quiet;
  const Table table = scalingTable(study, runs, quiet);
  ASSERT_EQ(table.rows.size(), 2);
  EXPECT_EQ(textAt(table, table.rows[0], "n"), "50");
  EXPECT_GT(numberAt(table, table.rows[0], "step_s"), 0);
  EXPECT_LT(numberAt(table, table.rows[0], "step_s"), 1);
  EXPECT_GE(numberAt(table, table.rows[0], "iterations"), 1);
}

}  // namespace
}  // namespace irk
