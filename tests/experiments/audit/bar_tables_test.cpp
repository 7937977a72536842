#include "experiments/audit/bar_tables.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "experiments/base/numbers.h"
#include "experiments/runs/run_table.h"
#include "tests/experiments/analyses/analysis_tables.h"

namespace irk::audit {
namespace {

// Rows of an audit: integrator, configuration, outcome, error, bar, part of the cover, time of the second integration
// (the first takes 2 s); tolerance 1e-6, exact references.
Table auditOf(const std::vector<std::array<std::string, 7>>& runs) {
  Table table{{},
              {"scene", "collection", "family", "integrator", "configuration", "outcome", "tolerance", "error",
               "error_in_tolerances", "error_bar", "part_of_cover", "cpu_error_bar_s", "cpu_s", "accuracy"},
              {}};
  for (const auto& [integrator, configuration, outcome, error, bar, part, second] : runs) {
    const std::string in_tolerances = numberText(std::stod(error) / 1e-6);
    table.rows.push_back({"kaps", "probes", "gauss", integrator, configuration, outcome, "1e-6", error, in_tolerances,
                          bar, part, second, "2", "0"});
  }
  return table;
}

std::string cell(const Table& table, const std::string& by, const std::string& group, const std::string& column) {
  for (const auto& row : table.rows) {
    if (row[0] == by && row[1] == group) return textAt(table, row, column);
  }
  return "no such row";
}

TEST(AuditTables, CountWhatTheErrorBarIsWorth) {
  const Table audit = auditOf({
      {"default", "default", "success", "1e-6", "2e-6", "0.5", "2"},        // covered
      {"default", "default", "success", "1e-6", "1e-8", "1.5", "2.2"},      // not covered, bar / error 0.01
      {"default", "default", "success", "1e-13", "1e-6", "0", "8"},         // too exact to divide by
      {"default", "default", "success", "1e-6", "nan", "nan", "nan"},       // bar unknown
      {"variable", "variable", "success", "1e-6", "1e-6", "0.3", "2.6"},    // covered
      {"variable", "variable", "inaccurate", "9e-5", "1", "nan", "2.6"},    // a false alarm: 90 tolerances
      {"variable", "variable", "inaccurate", "1.1e-4", "1", "nan", "2.6"},  // right to refuse
      {"variable", "variable", "stalled", "nan", "nan", "nan", "nan"},      // it did not reach the end
      {"cvode_bdf", "default", "success", "1", "nan", "nan", "nan"},        // has no bar
  });
  const Table bars = ofFile(audit, errorBarTable);
  EXPECT_EQ(cell(bars, "all", "all", "successes"), "5");
  EXPECT_EQ(cell(bars, "all", "all", "unknown"), "1");
  EXPECT_EQ(cell(bars, "all", "all", "judged"), "4");
  EXPECT_EQ(cell(bars, "all", "all", "covered"), "3");
  EXPECT_EQ(cell(bars, "all", "all", "coverage"), "0.75");
  EXPECT_EQ(cell(bars, "all", "all", "sharp_runs"), "3");
  EXPECT_EQ(cell(bars, "all", "all", "sharp_10"), "0.01");
  EXPECT_EQ(cell(bars, "all", "all", "sharp_median"), "1");
  EXPECT_EQ(cell(bars, "all", "all", "sharp_90"), "2");
  EXPECT_EQ(cell(bars, "configuration", "default", "sharp_share"), "0.5");
  EXPECT_EQ(cell(bars, "all", "all", "near_runs"), "6");
  EXPECT_EQ(cell(bars, "all", "all", "false_alarms"), "1");
  EXPECT_EQ(cell(bars, "configuration", "variable", "false_share"), "0.5");
  EXPECT_EQ(cell(bars, "configuration", "default", "cost_median"), "1.1");
  EXPECT_EQ(cell(bars, "configuration", "variable", "cost_median"), "1.3");
  EXPECT_EQ(cell(bars, "scene", "kaps", "judged"), "4");
  const std::string text = errorBarText(bars);
  EXPECT_TRUE(
      containsAll(text, {"coverage", "configuration variable", "collection probes", "asked: coverage >= 0.999"}))
      << text;
}

TEST(AuditTables, CountWrongWordsOfEachIntegrator) {
  const Table audit = auditOf({
      {"default", "default", "success", "9e-5", "1e-6", "1", "2"},
      {"default", "default", "success", "2e-4", "1e-6", "1", "2"},      // above 100
      {"default", "default", "inaccurate", "2e-2", "2e-2", "1", "2"},   // a success but for the bar: above 1000
      {"default", "default", "inaccurate", "2e-2", "nan", "nan", "2"},  // told by itself
      {"ida_bdf", "default", "success", "inf", "nan", "nan", "nan"},    // there is no solution
      {"ida_bdf", "default", "success", "nan", "nan", "nan", "nan"},    // no reference
      {"ida_bdf", "default", "stalled", "nan", "nan", "nan", "nan"},
  });
  const Table words = ofFile(audit, ownWordTable);
  const auto row = [&](const std::string& by, const std::string& group) {
    TableRow cells;
    for (const char* column : {"runs", "successes", "judged", "above_100", "above_1000"}) {
      cells.push_back(cell(words, by, group, column));
    }
    return cells;
  };
  EXPECT_EQ(row("all", "default"), (TableRow{"4", "3", "3", "2", "1"}));
  EXPECT_EQ(row("all", "ida_bdf"), (TableRow{"3", "2", "1", "1", "1"}));
  EXPECT_EQ(row("probes", "ida_bdf"), row("all", "ida_bdf"));
  EXPECT_TRUE(containsAll(ownWordText(words), {"above 100", "probes ida_bdf"}));
}

}  // namespace
}  // namespace irk::audit
