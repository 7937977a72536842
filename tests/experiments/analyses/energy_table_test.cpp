// The table of energies: times, errors and the fit are in their own columns.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "experiments/analyses/energy.h"
#include "experiments/runs/run_table.h"
#include "tests/experiments/analyses/analysis_tables.h"
#include "tests/experiments/study_runs.h"

namespace irk {
namespace {

TEST(EnergyTable, HoldsTimesAndErrorsUnderTheirNames) {
  const auto [study, runs] = runsOf(R"(
energy = true
[[block]]
scene = "kepler"
settings = "e=0.3"
methods = "gauss_2"
steps = [0.125]
t_end = 5
)");
  const Table table = energyTable(study, runs);
  ASSERT_GE(table.rows.size(), 20u);
  std::vector<double> t, error;
  double largest = 0;
  for (const auto& row : table.rows) {
    t.push_back(numberAt(table, row, "t"));
    error.push_back(numberAt(table, row, "energy_error"));
    largest = std::max(largest, std::abs(error.back()));
    EXPECT_EQ(numberAt(table, row, "h"), 0.125);
  }
  EXPECT_TRUE(std::is_sorted(t.begin(), t.end()));
  EXPECT_NEAR(t.back(), 5, 1e-12);
  EXPECT_GT(largest, 0);
  EXPECT_LT(largest, 1e-2) << "an error, not a time";
  const EnergyDrift fit = energyDrift(t, error);
  const auto& row = table.rows.front();
  EXPECT_NEAR(numberAt(table, row, "drift"), fit.drift, 1e-3 * std::abs(fit.drift) + 1e-18);
  EXPECT_NEAR(numberAt(table, row, "scatter"), fit.scatter, 1e-3 * fit.scatter);
  EXPECT_NEAR(numberAt(table, row, "largest"), largest, 1e-3 * largest);
}

}  // namespace
}  // namespace irk
