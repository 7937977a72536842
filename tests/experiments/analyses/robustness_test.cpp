#include "experiments/analyses/costs/robustness.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "experiments/analyses/costs/gaps.h"
#include "experiments/runs/run_table.h"
#include "tests/experiments/analyses/analysis_tables.h"

namespace irk {
namespace {

// hires belongs to the collection ivp, "mine" to none. The bar of tolerance 1e-4 is 0.1 + 1e-9.
TEST(Robustness, CountsRunsByCollectionSolverAndTolerance) {
  Table runs;
  runs.columns = {"scene", "integrator", "control", "rtol", "atol", "outcome", "error_u", "error_v", "error_x"};
  const auto add = [&](const char* scene, const char* tolerance, const char* outcome, const char* error,
                       const char* control = "predictive") {
    runs.rows.push_back({scene, "variable", control, tolerance, tolerance, outcome, "nan", "nan", error});
  };
  add("hires", "1e-4", "success", "0.0999");
  add("hires", "1e-4", "success", "0.1001");
  add("hires", "1e-4", "timeout", "nan");
  add("mine", "1e-4", "max_steps", "nan");
  add("mine", "1e-6", "success", "1e-5");
  add("mine", "1e-6", "success", "nan");          // no reference
  add("hires", "1e-6", "refused", "nan");         // the solver cannot be applied
  add("hires", "1e-6", "success", "1", "fixed");  // no tolerance
  const Table table = robustnessTable(runs);
  std::map<std::string, std::string> counts;
  for (const auto& row : table.rows) {
    std::string numbers;
    for (const char* column : {"runs", "right", "failed", "wrong", "unjudged"})
      numbers += textAt(table, row, column) + " ";
    counts[textAt(table, row, "collection") + " " + textAt(table, row, "tolerance")] =
        numbers + textAt(table, row, "outcomes");
  }
  EXPECT_EQ(counts, (std::map<std::string, std::string>{{"all 1e-04", "4 1 2 1 0 max_steps 1; timeout 1"},
                                                        {"all 1e-06", "2 1 0 0 1 "},
                                                        {"all all", "6 2 2 1 1 max_steps 1; timeout 1"},
                                                        {"ivp 1e-04", "3 1 1 1 0 timeout 1"},
                                                        {"ivp all", "3 1 1 1 0 timeout 1"}}));
  EXPECT_EQ(textAt(table, table.rows[0], "integrator"), "variable");
}

// One integrator in two formulations is two solvers; another in one formulation keeps its name.
TEST(Robustness, TellsFormulationsOfOneIntegratorApart) {
  Table runs;
  runs.columns = {"scene", "integrator", "formulation", "control", "rtol",
                  "atol",  "outcome",    "error_u",     "error_v", "error_x"};
  const auto add = [&](const char* integrator, const char* formulation, const char* outcome) {
    runs.rows.push_back({"mine", integrator, formulation, "predictive", "1e-4", "1e-4", outcome, "0", "0", "0"});
  };
  add("variable", "index3", "stalled");
  add("variable", "index2", "success");
  add("ida_bdf", "index2", "success");
  add("ida_bdf", "index3", "refused");
  std::map<std::string, std::string> right;
  const Table table = robustnessTable(runs);
  for (const auto& row : table.rows) right[textAt(table, row, "integrator")] = textAt(table, row, "right");
  EXPECT_EQ(right,
            (std::map<std::string, std::string>{{"variable:index3", "0"}, {"variable:index2", "1"}, {"ida_bdf", "1"}}));
}

// The bar of tolerance 1e-4 is 0.1 + 1e-9.
TEST(Gaps, AreRunsThatAreNotRightWhereAnotherSolverIs) {
  Table runs;
  runs.columns = {"scene",   "settings", "integrator", "control", "rtol",   "atol",
                  "outcome", "detail",   "error_u",    "error_v", "error_x"};
  const auto add = [&](const char* scene, const char* integrator, const char* tolerance, const char* outcome,
                       const char* error, const char* control = "predictive") {
    runs.rows.push_back(
        {scene, "", integrator, control, tolerance, tolerance, outcome, "because", error, "nan", "nan"});
  };
  add("a", "one", "1e-4", "success", "0");
  add("a", "two", "1e-4", "stalled", "nan");
  add("a", "three", "1e-4", "success", "0.2");         // wrong
  add("a", "four", "1e-4", "refused", "nan");          // cannot be applied
  add("a", "five", "1e-4", "success", "nan");          // no reference: neither right nor wrong
  add("a", "six", "1e-4", "success", "0.2", "fixed");  // no tolerance
  add("a", "one", "1e-6", "stalled", "nan");           // no solver is right
  add("a", "two", "1e-6", "stalled", "nan");
  add("b", "two", "1e-4", "success", "0");
  add("b", "one", "1e-4", "success", "0.0999");
  const Table table = analysisOf(runs, writeGaps);
  std::vector<std::string> found;
  for (const auto& row : table.rows) {
    std::string text;
    for (const char* column : {"scene", "tolerance", "solver", "judgement", "outcome", "detail", "right"}) {
      text += textAt(table, row, column) + " ";
    }
    found.push_back(text);
  }
  EXPECT_EQ(found, (std::vector<std::string>{"a 1e-04 two failed stalled because one ",
                                             "a 1e-04 three wrong success because one "}));
}

}  // namespace
}  // namespace irk
