#include "experiments/analyses/costs/profile.h"

#include <gtest/gtest.h>

#include <map>

#include "experiments/base/numbers.h"
#include "experiments/runs/run_table.h"
#include "tests/experiments/analyses/analysis_tables.h"

namespace irk {
namespace {

// Two problems. `variable` takes 1 and 4; `cvode_bdf` takes 2 and 2 (8 with another formulation); `paper` solves only
// the second one, in 6.
TEST(Profile, CountsProblemsWithinARatioOfTheBest) {
  Table costs;
  costs.columns = {"scene", "settings", "integrator", "target_error", "cpu_s", "cause"};
  costs.rows = {{"a", "", "variable", "1e-6", "1", ""},
                {"b", "", "variable", "1e-6", "4", ""},
                {"a", "", "cvode_bdf", "1e-6", "8", ""},
                {"a", "", "cvode_bdf", "1e-6", "2", ""},
                {"b", "", "cvode_bdf", "1e-6", "2", ""},
                {"a", "", "paper:radau_iia_5", "1e-6", "nan", "not accurate enough"},
                {"b", "", "paper:radau_iia_5", "1e-6", "6", ""}};
  const Table profile = profileTable(costs);
  std::map<std::string, std::vector<std::pair<double, double>>> curves;
  for (const auto& row : profile.rows) {
    if (textAt(profile, row, "target_error") != "all") continue;
    curves[textAt(profile, row, "integrator")].emplace_back(numberAt(profile, row, "ratio"),
                                                            numberAt(profile, row, "fraction"));
  }
  using Curve = std::vector<std::pair<double, double>>;
  EXPECT_EQ(curves["variable"], (Curve{{1, 0.5}, {2, 1}, {1e6, 1}}));
  EXPECT_EQ(curves["cvode_bdf"], (Curve{{1, 0.5}, {2, 1}, {1e6, 1}}));
  EXPECT_EQ(curves["paper:radau_iia_5"], (Curve{{3, 0.5}, {1e6, 0.5}}));
  EXPECT_EQ(curves.size(), 3);
}

// The curve of a solver that solves all given problems ends at 1. `narrow` was given two of the three problems and
// solves both. No solver solves "d"; "e" has no reference.
TEST(Profile, DividesByTheProblemsThatASolverWasGiven) {
  Table costs;
  costs.columns = {"scene", "settings", "integrator", "target_error", "cpu_s", "cause"};
  const std::string fails = "not accurate enough", unknown = "no reference";
  costs.rows = {{"a", "", "wide", "1e-6", "1", ""},        {"b", "", "wide", "1e-6", "1", ""},
                {"c", "", "wide", "1e-6", "nan", fails},   {"d", "", "wide", "1e-6", "nan", fails},
                {"e", "", "wide", "1e-6", "nan", unknown}, {"b", "", "narrow", "1e-6", "2", ""},
                {"c", "", "narrow", "1e-6", "2", ""},      {"e", "", "narrow", "1e-6", "nan", unknown}};
  const Table profile = profileTable(costs);
  std::map<std::string, TableRow> last;
  for (const auto& row : profile.rows) last[textAt(profile, row, "integrator")] = row;
  EXPECT_NEAR(numberAt(profile, last["wide"], "fraction"), 2.0 / 3, 1e-12);
  EXPECT_EQ(numberAt(profile, last["narrow"], "fraction"), 1);
  EXPECT_EQ(textAt(profile, last["wide"], "given"), "3");
  EXPECT_EQ(textAt(profile, last["narrow"], "given"), "2");
  for (const auto& [solver, row] : last) EXPECT_EQ(textAt(profile, row, "problems"), "3") << solver;
}

// A solver that was run with tolerances down to 1e-8 only was not asked for an error of 1e-10, and does not fail there.
TEST(Profile, AnErrorBelowTheSmallestToleranceWasNotAskedFor) {
  Table costs;
  costs.columns = {"scene", "settings", "integrator", "target_error", "cpu_s", "cause", "least_tolerance"};
  const std::string fails = "not accurate enough";
  costs.rows = {{"a", "", "fine", "1e-8", "1", "", "1e-10"},  {"a", "", "coarse", "1e-8", "nan", fails, "1e-8"},
                {"a", "", "fine", "1e-10", "2", "", "1e-10"}, {"a", "", "coarse", "1e-10", "nan", fails, "1e-8"},
                {"a", "", "fine", "1e-11", "3", "", "1e-10"}, {"a", "", "steps", "1e-10", "nan", fails, "nan"}};
  const Table profile = profileTable(costs);
  std::map<std::string, std::string> given;
  for (const auto& row : profile.rows) {
    given[textAt(profile, row, "target_error") + " " + textAt(profile, row, "integrator")] =
        textAt(profile, row, "given");
  }
  EXPECT_EQ(given, (std::map<std::string, std::string>{{"1e-8 fine", "1"},
                                                       {"1e-8 coarse", "1"},
                                                       {"1e-10 fine", "1"},
                                                       {"1e-10 steps", "1"},
                                                       {"all fine", "2"},
                                                       {"all coarse", "1"},
                                                       {"all steps", "1"}}));
}

// hires belongs to the collection ivp, pendulum to ivp and multibody, "mine" to none. A solver that cannot be applied
// to a scene does not count as failed there.
TEST(Profile, OfEveryCollectionAndOfAllScenes) {
  Table costs;
  costs.columns = {"scene", "settings", "integrator", "target_error", "cpu_s", "cause"};
  costs.rows = {
      {"hires", "", "variable", "1e-4", "1", ""},     {"pendulum", "", "variable", "1e-4", "3", ""},
      {"mine", "", "variable", "1e-4", "1", ""},      {"hires", "", "cvode_bdf", "1e-4", "2", ""},
      {"pendulum", "", "cvode_bdf", "1e-4", "1", ""}, {"mine", "", "cvode_bdf", "1e-4", "nan", "no success: refused"}};
  const Table profile = profileTable(costs);
  std::map<std::string, std::string> first, given;  // the part of the problems solved as fast as by the best
  for (const auto& row : profile.rows) {
    const std::string curve = textAt(profile, row, "collection") + " " + textAt(profile, row, "integrator");
    if (textAt(profile, row, "target_error") == "all" || numberAt(profile, row, "ratio") != 1) continue;
    first[curve] = textAt(profile, row, "fraction");
    given[curve] = textAt(profile, row, "given");
  }
  EXPECT_EQ(first, (std::map<std::string, std::string>{{"all cvode_bdf", "0.5"},
                                                       {"all variable", "0.6666666666666666"},
                                                       {"ivp cvode_bdf", "0.5"},
                                                       {"ivp variable", "0.5"},
                                                       {"multibody cvode_bdf", "1"}}));
  EXPECT_EQ(given["all variable"], "3");
  EXPECT_EQ(given["all cvode_bdf"], "2");
}

}  // namespace
}  // namespace irk
