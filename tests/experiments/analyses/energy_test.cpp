#include "experiments/analyses/energy.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "experiments/base/numbers.h"
#include "experiments/runs/run_table.h"
#include "tests/experiments/analyses/analysis_tables.h"
#include "tests/experiments/study_runs.h"

namespace irk {
namespace {

TEST(Energy, DriftIsTheSlopeAndScatterTheDistanceFromIt) {
  std::vector<double> t, error;
  for (int i = 0; i < 1000; ++i) {
    t.push_back(0.1 * i);
    error.push_back(2e-3 * t.back() + (i % 2 == 0 ? 1e-2 : -1e-2));
  }
  const EnergyDrift drift = energyDrift(t, error);
  EXPECT_NEAR(drift.drift, 2e-3, 1e-5);
  EXPECT_NEAR(drift.scatter, 1e-2, 1e-4);
  EXPECT_NEAR(drift.largest, 0.1998 + 0.01, 1e-3);
  EXPECT_TRUE(std::isnan(energyDrift({1, 2}, {0, 0}).scatter));
}

TEST(Energy, CompensatedSummationLowersItsScatterFivefold) {
  const auto [study, runs] = runsOf(R"(
energy = true
[[block]]
scene = "kepler"
settings = "e=0.3"
families = "gauss"
stages = 8
summation = ["compensated", "plain"]
steps = [0.01256637061435917]
t_end = 125.6637061435917
)");
  const Table table = energyTable(study, runs);
  std::map<std::string, double> scatter;
  for (const auto& row : table.rows) {
    scatter[textAt(table, row, "summation")] = numberAt(table, row, "scatter");
  }
  ASSERT_EQ(scatter.size(), 2);
  EXPECT_GT(scatter["compensated"], 0);
  EXPECT_GT(scatter["plain"], 5 * scatter["compensated"]);
  EXPECT_LT(scatter["plain"], 1e-13);
}

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
