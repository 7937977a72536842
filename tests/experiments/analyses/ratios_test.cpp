// Ratios of costs, from tables whose ratios are known.
#include "experiments/analyses/costs/ratios.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "experiments/base/numbers.h"
#include "experiments/report/ratios_html.h"
#include "experiments/runs/run_table.h"
#include "tests/experiments/analyses/analysis_tables.h"

namespace irk {
namespace {

// The cost of error e is `factor` e^(-1/2), in counters and, a thousandth of it, in seconds.
class Runs {
 public:
  Runs() {
    table.columns = {
        "scene",     "settings",  "method",         "jacobian",          "newton", "rtol", "outcome", "error", "cpu_s",
        "residuals", "jacobians", "factorizations", "newton_iterations", "block"};
  }
  void add(const char* block, const char* scene, const char* method, const char* jacobian, const char* newton,
           double factor, double least = 1e-6) {
    for (double error = 1e-2; error > least / 2; error /= 100) {
      const std::string cost = numberText(factor / std::sqrt(error));
      table.rows.push_back({scene, "", method, jacobian, newton, numberText(error), "success", numberText(error),
                            numberText(factor / std::sqrt(error) / 1000), cost, cost, cost, cost, block});
    }
  }
  Table table;
};

TEST(Ratios, CompareWithTheFirstChoiceOfABlock) {
  Runs runs;
  runs.add("terms", "crank", "radau_iia_3", "full", "simplified", 2);
  runs.add("terms", "crank", "radau_iia_3", "full", "modified", 6);
  runs.add("terms", "crank", "radau_iia_3", "no_mass", "simplified", 3);
  runs.add("terms", "crank", "radau_iia_3", "no_mass", "modified", 6);
  runs.add("terms", "crank", "radau_iia_5", "full", "simplified", 2);
  runs.add("terms", "crank", "radau_iia_5", "no_mass", "simplified", 4, 1e-4);
  runs.add("alone", "rod", "radau_iia_3", "no_mass", "modified", 1);  // nothing to compare with
  const Table ratios = ratioTable(runs.table, {1e-3, 1e-4, 1e-5});
  const auto found = [&](const std::string& method, const std::string& value, const std::string& others,
                         const char* column) {
    for (const auto& row : ratios.rows) {
      if (textAt(ratios, row, "method") == method && textAt(ratios, row, "value") == value &&
          textAt(ratios, row, "others") == others)
        return numberAt(ratios, row, column);
    }
    ADD_FAILURE() << method << " " << value << " " << others;
    return std::nan("");
  };
  EXPECT_EQ(ratios.rows.size(), 5u);
  for (const char* cost : kRatioCosts) {
    EXPECT_NEAR(found("radau_iia_3", "no_mass", "newton=simplified", cost), 1.5, 1e-9) << cost;
    EXPECT_NEAR(found("radau_iia_3", "no_mass", "newton=modified", cost), 1, 1e-9) << cost;
    EXPECT_NEAR(found("radau_iia_3", "modified", "jacobian=full", cost), 3, 1e-9) << cost;
    EXPECT_NEAR(found("radau_iia_3", "modified", "jacobian=no_mass", cost), 2, 1e-9) << cost;
    EXPECT_NEAR(found("radau_iia_5", "no_mass", "newton=simplified", cost), 2, 1e-9) << cost;
  }
  EXPECT_EQ(found("radau_iia_3", "no_mass", "newton=simplified", "errors"), 3);
  EXPECT_EQ(found("radau_iia_5", "no_mass", "newton=simplified", "errors"), 2);
  EXPECT_EQ(found("radau_iia_5", "no_mass", "newton=simplified", "lost"), 1);
  EXPECT_EQ(found("radau_iia_5", "no_mass", "newton=simplified", "won"), 0);

  // The page takes the medians over methods and Newton methods: of 1, 1.5 and 2, and of 2 and 3.
  const HtmlTable html = ratiosHtml(ratios);
  ASSERT_EQ(html.rows.size(), 2u);
  std::map<std::string, std::vector<std::string>> shown;
  for (const auto& row : html.rows) shown[row.cells[1]] = row.cells;
  EXPECT_EQ(shown["jacobian = no_mass"],
            (std::vector<std::string>{"crank", "jacobian = no_mass", "full", "1.50", "1.00 … 2.00", "1.50", "1.50",
                                      "1.50", "1.50", "1", "0"}));
  EXPECT_EQ(shown["newton = modified"],
            (std::vector<std::string>{"crank", "newton = modified", "simplified", "2.50", "2.00 … 3.00", "2.50", "2.50",
                                      "2.50", "2.50", "0", "0"}));
  const auto sentence = ratiosSentence(ratios);
  EXPECT_NE(sentence.find("in 0 of 2 comparisons"), sentence.npos) << sentence;
  EXPECT_NE(sentence.find("from 1.50 (`jacobian = no_mass` instead of `full`, crank) to 2.50 (`newton = modified`"),
            sentence.npos)
      << sentence;
}

TEST(Ratios, GiveASentenceOnlyWithTimes) {
  Runs runs;
  runs.add("terms", "crank", "radau_iia_3", "full", "simplified", 2);
  runs.add("terms", "crank", "radau_iia_3", "no_mass", "simplified", 3);
  for (auto& row : runs.table.rows) row[runs.table.column("cpu_s")] = "nan";
  const Table ratios = ratioTable(runs.table, {1e-3});
  ASSERT_EQ(ratios.rows.size(), 1u);
  EXPECT_TRUE(std::isnan(numberAt(ratios, ratios.rows.front(), "cpu_s")));
  EXPECT_NEAR(numberAt(ratios, ratios.rows.front(), "jacobians"), 1.5, 1e-9);
  EXPECT_EQ(ratiosSentence(ratios), "");
  EXPECT_EQ(ratiosHtml(ratios).rows.front().cells[3], "–");
}

}  // namespace
}  // namespace irk
