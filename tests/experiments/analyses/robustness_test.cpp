#include "experiments/analyses/costs/robustness.h"

#include <gtest/gtest.h>

#include <map>

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

}  // namespace
}  // namespace irk
