#include "experiments/analyses/costs/cost_at_error.h"
#include "tests/experiments/analyses/analysis_tables.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

namespace irk {
namespace {

TEST(CostAtError, InterpolatesTheLowerEnvelope) {
  // cost = error^(-1/2), and one point above the envelope.
  const std::vector<CostPoint> points{{1e-2, 10}, {1e-4, 100}, {1e-6, 1000}, {1e-3, 500}};
  EXPECT_NEAR(costAtError(points, 1e-4), 100, 1e-9);
  EXPECT_NEAR(costAtError(points, 1e-5), std::pow(10, 2.5), 1e-9);
  EXPECT_NEAR(costAtError(points, 0.5), 10, 1e-9);
  EXPECT_TRUE(std::isnan(costAtError(points, 1e-7)));
  EXPECT_TRUE(std::isnan(costAtError({}, 1)));
}

// Every series has a row for every error, with a cause if there is no cost.
TEST(CostAtError, NamesTheCauseOfAMissingCost) {
  Table runs;
  runs.columns = {"scene",     "outcome",           "error",     "cpu_s",
                  "residuals", "newton_iterations", "jacobians", "factorizations"};
  const auto add = [&](const char* scene, const char* outcome, const char* error) {
    runs.rows.push_back({scene, outcome, error, "1", "1", "1", "1", "1"});
  };
  add("reached", "success", "1e-7");
  add("coarse", "success", "1e-3");
  add("unknown", "success", "nan");
  add("failed", "newton_failed", "nan");
  add("failed", "timeout", "nan");
  const Table costs = costTable(runs, {1e-6});
  std::map<std::string, std::string> causes;
  for (const auto& row : costs.rows) {
    causes[textAt(costs, row, "scene")] = textAt(costs, row, "cause");
    EXPECT_EQ(textAt(costs, row, "reached") == "1", textAt(costs, row, "cause").empty());
  }
  EXPECT_EQ(causes, (std::map<std::string, std::string>{{"reached", ""},
                                                        {"coarse", "not accurate enough"},
                                                        {"unknown", "no reference"},
                                                        {"failed", "no success: timeout"}}));
}

TEST(CostAtError, GivesTheSmallestToleranceOfASeries) {
  Table runs;
  runs.columns = {"scene",     "control",           "rtol",      "atol",          "outcome", "error", "cpu_s", "h",
                  "residuals", "newton_iterations", "jacobians", "factorizations"};
  const auto add = [&](const char* scene, const char* control, const char* rtol, const char* atol) {
    runs.rows.push_back({scene, control, rtol, atol, "success", "1e-3", "1", "0", "1", "1", "1", "1"});
  };
  add("relative", "predictive", "1e-4", "1e-4");
  add("relative", "predictive", "1e-7", "1e-7");
  add("relative", "predictive", "1e-5", "1e-5");
  add("absolute", "paper", "0", "1e-6");
  add("steps", "fixed", "1e-6", "1e-6");
  const Table costs = costTable(runs, {1e-8});
  ASSERT_EQ(costs.rows.size(), 3u);
  EXPECT_EQ(numberAt(costs, costs.rows[0], "least_tolerance"), 1e-7);
  EXPECT_EQ(numberAt(costs, costs.rows[1], "least_tolerance"), 1e-6);
  EXPECT_TRUE(std::isnan(numberAt(costs, costs.rows[2], "least_tolerance")));
}

// An error below ten times the accuracy of a computed reference is only known to be below that bound. The run reaches
// every target above the bound; whether it reaches smaller ones is unknown.
TEST(CostAtError, CountsAnErrorThatIsNotMeasurableAsItsBound) {
  Table runs;
  runs.columns = {"scene",     "outcome",           "error",     "reference_accuracy", "cpu_s",
                  "residuals", "newton_iterations", "jacobians", "factorizations"};
  runs.rows.push_back({"a", "success", "1e-4", "1e-12", "1", "1", "1", "1", "1"});
  runs.rows.push_back({"a", "success", "nan", "1e-12", "3", "3", "3", "3", "3"});
  const Table costs = costTable(runs, {1e-3, 1e-11, 1e-12});
  ASSERT_EQ(costs.rows.size(), 3u);
  EXPECT_EQ(numberAt(costs, costs.rows[0], "cpu_s"), 1);
  EXPECT_DOUBLE_EQ(numberAt(costs, costs.rows[1], "cpu_s"), 3) << "1e-11 is the bound of the second run";
  EXPECT_EQ(textAt(costs, costs.rows[2], "reached"), "0");
  EXPECT_EQ(textAt(costs, costs.rows[2], "cause"), kNotMeasurable);
}

}  // namespace
}  // namespace irk
