#include "experiments/report/answers/order_answer.h"

#include <gtest/gtest.h>

#include "experiments/report/answers/formula.h"
#include "tests/experiments/report/answer_tables.h"
#include "tests/experiments/support.h"

namespace irk::report {
namespace {

// Expected: the tables of Hairer & Wanner and Hairer, Lubich & Roche.
TEST(OrderFormula, FollowsTheory) {
  const auto text = [](const char* family, SystemKind kind, char component) {
    const auto formula = orderFormula(family, kind, component);
    return formula ? formula->text : "none";
  };
  EXPECT_EQ(text("gauss", SystemKind::kOde, 'x'), "2s");
  EXPECT_EQ(text("radau_iia", SystemKind::kIndex2, 'x'), "2s − 1");
  EXPECT_EQ(text("radau_iia", SystemKind::kIndex2, 'z'), "s");
  EXPECT_EQ(text("gauss", SystemKind::kIndex1, 'z'), "s; odd s: s + 1");
  EXPECT_EQ(text("gauss", SystemKind::kMechanical3, 'z'), "s − 4; odd s: s − 3");
  EXPECT_EQ(text("radau_ia", SystemKind::kIndex2, 'z'), "s − 1; s = 1: 1");
  EXPECT_EQ(text("lobatto_iiia", SystemKind::kIndex2, 'z'), "s; odd s: s − 1");
  EXPECT_EQ(text("lobatto_iiia", SystemKind::kMechanical3, 'u'), "2s − 2; odd s: 2s − 4");
  EXPECT_EQ(text("lobatto_iiib", SystemKind::kIndex2, 'x'), "none");
  EXPECT_EQ(text("sdirk", SystemKind::kOde, 'x'), "none");
  EXPECT_TRUE(orderFormula("gauss", SystemKind::kOde, 'x')->theorem);
  EXPECT_FALSE(orderFormula("gauss", SystemKind::kMechanical2, 'u')->theorem) << "a measured pattern";
}

Table orders(const std::vector<Cells>& rows) {
  return tableOf({"scene", "settings", "formulation", "family", "stages", "component", "power_of", "order", "theory",
                  "source", "h_min", "verdict"},
                 rows);
}

Cells order(const char* scene, const char* family, const char* component, const char* order, const char* theory,
            const char* verdict, const char* source = "theorem") {
  return {{"scene", scene},  {"formulation", "index2"}, {"family", family}, {"component", component},
          {"power_of", "h"}, {"order", order},          {"theory", theory}, {"h_min", "0.01"},
          {"stages", "3"},   {"verdict", verdict},      {"source", source}};
}

TEST(OrderAnswer, CountsWhatAgreesByFamilyAndComponent) {
  claims::ResultTables tables;
  tables.put("order", "orders",
             orders({order("mechanical_dae", "gauss", "u", "4.01", "4", "agrees"),
                     order("mechanical_dae", "gauss", "u", "5.5", "6", "differs", "measured"),
                     order("mechanical_dae", "gauss", "u", "nan", "8", "not_measurable"),
                     order("riccati_tracking", "radau_iia", "x", "3.1", "3", "agrees"),
                     order("mechanical_dae", "gauss", "z", "2", "nan", "no_theory")}));
  const Answer answer = orderAnswer(tables);
  EXPECT_TRUE(containsAll(answer.sentences.at(0),
                          {"2 of 3 measured orders agree with theory: 2 of 2 with theorems, 0 of 1 with "
                           "patterns",
                           "difference is 0.5", "1 more series"}));
  bool found = false;
  for (std::size_t i = 0; i < answer.table.rows.size(); ++i) {
    if (cell(answer.table, i, "system") != "mechanical_index2" || cell(answer.table, i, "component") != "u" ||
        cell(answer.table, i, "family") != "gauss") {
      continue;
    }
    found = true;
    EXPECT_EQ(cell(answer.table, i, "formula"), "2s");
    EXPECT_EQ(cell(answer.table, i, "agree"), "1");
    EXPECT_EQ(cell(answer.table, i, "differ"), "1");
    EXPECT_EQ(cell(answer.table, i, "not_measurable"), "1");
  }
  EXPECT_TRUE(found);
  const std::string html = htmlOf(answer.shown);
  EXPECT_TRUE(containsAll(html, {"✗ 1/2, s = 3: 5.5 instead of 6, 1 not measurable", "✓ 1/1"}));
  EXPECT_EQ(answer.sentences.at(1), "Those that differ have s = 3 and lie 0.5 to 0.5 from theory.");
}

TEST(OrderAnswer, HasTheFormulasWithoutRuns) {
  const Answer answer = orderAnswer(claims::ResultTables{});
  EXPECT_TRUE(containsAll(answer.sentences.at(0), {"Not checked yet", "irk run order"}));
  EXPECT_TRUE(containsAll(htmlOf(answer.shown), {"2s − 1"}));
  // The multiplier of Gauss has order s - 4 or s - 3 in index 3.
  EXPECT_TRUE(containsAll(htmlOf(answer.shown), {"no convergence for s ≤ 4"}));
  // Stiffly accurate families keep their order in index 2, the others lose it in the velocities.
  EXPECT_TRUE(containsAll(answer.sentences.at(1), {"with Radau IIA, Lobatto IIIA and Lobatto IIIC; only the positions "
                                                   "keep it with Gauss and Radau IA."}));
}

}  // namespace
}  // namespace irk::report
