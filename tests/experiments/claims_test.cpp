#include "experiments/claims/claims.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include "experiments/builtin_studies.h"
#include "experiments/claims/measures.h"
#include "experiments/newmark.h"
#include "experiments/report.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

const Claim& claim(std::string_view id) {
  for (const auto& one : claims()) {
    if (one.id == id) return one;
  }
  throw std::runtime_error("no claim " + std::string(id));
}

Verdict verdict(std::string_view id, const ResultTables& tables) {
  return judge(claim(id), tables).verdict;
}

std::string text(double x) { return std::to_string(x); }

/// Runs of one method with cost = scale * error^(-1/4), all else as given.
void addSeries(Table& table, const std::map<std::string, std::string>& cells, double scale) {
  for (const double error : {1e-2, 1e-4, 1e-6, 1e-8, 1e-11}) {
    TableRow row;
    for (const auto& column : table.columns) {
      const auto given = cells.find(column);
      const double cost = scale * std::pow(error, -0.25);
      if (given != cells.end()) {
        row.push_back(given->second);
      } else if (column == "outcome") {
        row.emplace_back("success");
      } else if (column == "error") {
        row.push_back(fmt::format("{}", error));
      } else {
        row.push_back(fmt::format("{}", cost));  // every kind of cost
      }
    }
    table.rows.push_back(std::move(row));
  }
}

Table costColumns(std::vector<std::string> more) {
  Table table;
  table.columns = std::move(more);
  table.columns.insert(table.columns.end(), {"outcome", "error", "cpu_s", "newton_iterations",
                                             "jacobians", "residuals"});
  return table;
}

TEST(Claims, AreFifteenAndComplete) {
  ASSERT_EQ(claims().size(), 15u);
  std::set<std::string> known;
  for (const auto& study : builtinStudies()) known.emplace(study.id);
  std::set<std::string> figures;
  for (const auto& figure :
       readFigures(std::filesystem::path(IRK_SOURCE_DIR) / "plots/figures.txt")) {
    figures.insert(figure.name);
  }
  for (std::size_t i = 0; i < claims().size(); ++i) {
    const auto& one = claims()[i];
    EXPECT_EQ(one.id, "C" + std::to_string(i + 1));
    EXPECT_FALSE(one.statement.empty());
    for (const auto study : one.studies) EXPECT_TRUE(known.contains(std::string(study))) << study;
    for (const auto name : one.figures) EXPECT_TRUE(figures.contains(std::string(name))) << name;
  }
}

TEST(Claims, WithoutResultsSayWhichStudyIsMissing) {
  const ResultTables nothing;
  for (const auto& one : claims()) {
    if (one.studies.empty()) continue;
    const Finding finding = judge(one, nothing);
    EXPECT_EQ(finding.verdict, Verdict::kNotMeasurable) << one.id;
    EXPECT_TRUE(containsAll(finding.reason, {"study ", " has not been run"})) << one.id;
  }
  EXPECT_TRUE(containsAll(claimsText(nothing), {"C1 ", "C15 ", "not measurable", "irk run "}));
}

TEST(Claims, DroppedMassDerivatives) {
  const auto tables = [](double factor) {
    ResultTables results;
    Table runs = costColumns({"scene", "method", "newton", "jacobian"});
    const auto add = [&](const char* scene, const char* terms, double scale) {
      addSeries(runs,
                {{"scene", scene},
                 {"method", "radau_iia_3"},
                 {"newton", "simplified"},
                 {"jacobian", terms}},
                scale);
    };
    add("slider_crank_flexible", "full", 1);
    add("slider_crank_flexible", "no_mass", factor);
    add("ancf_pendulum", "full", 1);
    add("ancf_pendulum", "no_mass", 1);
    results.put("jacobian", "runs", runs);
    return results;
  };
  EXPECT_EQ(verdict("C5", tables(0.9)), Verdict::kConfirmed);
  EXPECT_EQ(verdict("C5", tables(1.05)), Verdict::kWithinLimits);  // little, but not faster
  EXPECT_EQ(verdict("C5", tables(3)), Verdict::kContradicted);
  EXPECT_TRUE(containsAll(judge(claim("C5"), tables(3)).number, {"3 times the iterations"}));
}

TEST(Claims, RuleOfTheModifiedNewtonMethod) {
  const auto tables = [](double papers) {
    ResultTables results;
    Table runs = costColumns({"scene", "settings", "method", "contractivity_limit",
                              "contractivity_after", "max_iterations"});
    const auto add = [&](const char* limit, double scale) {
      addSeries(runs,
                {{"scene", "slider_crank"},
                 {"settings", ""},
                 {"method", "radau_iia_3"},
                 {"contractivity_limit", limit},
                 {"contractivity_after", "3"},
                 {"max_iterations", "25"}},
                scale);
    };
    add("0.69999999999999996", papers);
    add("0.5", 1);
    results.put("newton_rule", "runs", runs);
    return results;
  };
  EXPECT_EQ(verdict("C12", tables(1)), Verdict::kConfirmed);
  EXPECT_EQ(verdict("C12", tables(1.2)), Verdict::kWithinLimits);
  EXPECT_EQ(verdict("C12", tables(2)), Verdict::kContradicted);
}

TEST(Claims, Families) {
  const auto tables = [](double radau) {
    Table costs;
    costs.columns = {"scene", "family", "stages", "target_error", "cpu_s", "reached"};
    for (const auto* error : {"1e-4", "1e-6"}) {
      costs.rows.push_back({"pendulum", "radau_iia", "3", error, text(radau), "1"});
      costs.rows.push_back({"pendulum", "radau_iia", "2", error, "9", "1"});
      costs.rows.push_back({"pendulum", "gauss", "3", error, "1", "1"});
      costs.rows.push_back({"pendulum", "lobatto_iiia", "3", error, "nan", "0"});
    }
    ResultTables results;
    results.put("families", "cpu_at_error", costs);
    return results;
  };
  EXPECT_EQ(verdict("C13", tables(0.5)), Verdict::kConfirmed);
  EXPECT_EQ(verdict("C13", tables(1.05)), Verdict::kConfirmed);
  EXPECT_EQ(verdict("C13", tables(2)), Verdict::kContradicted);
}

TEST(Claims, Drift) {
  const auto tables = [](const char* drift) {
    ResultTables results;
    Table runs =
        costColumns({"scene", "method", "family", "stages", "formulation", "rtol", "drift"});
    for (const auto* formulation : {"index2", "ggl"}) {
      addSeries(runs,
                {{"scene", "pendulum"},
                 {"method", "radau_iia_3"},
                 {"family", "radau_iia"},
                 {"stages", "3"},
                 {"formulation", formulation},
                 {"rtol", "1e-6"},
                 {"drift", drift}},
                1);
    }
    results.put("drift", "runs", runs);
    return results;
  };
  EXPECT_EQ(verdict("C7", tables("1e-9")), Verdict::kConfirmed);
  EXPECT_EQ(verdict("C7", tables("1e-3")), Verdict::kContradicted);
}

TEST(Claims, SharesOfTheFactorization) {
  const auto tables = [](const char* evaluation, const char* factorization) {
    Table phases;
    phases.columns = {"solver", "n", "share_residual", "share_jacobian", "share_factorization"};
    phases.rows = {{"coupled_dense", "20", evaluation, "0.1", factorization},
                   {"coupled_dense", "500", "0.1", "0.1", "0.7"},  // beyond the claim
                   {"schur", "20", "0.1", "0.1", "0.7"}};
    ResultTables results;
    results.put("phases", "phases", phases);
    return results;
  };
  EXPECT_EQ(verdict("C4", tables("0.6", "0.2")), Verdict::kConfirmed);
  EXPECT_EQ(verdict("C4", tables("0.1", "0.7")), Verdict::kContradicted);
}

TEST(Claims, NewmarkIsLobattoIIIA) {
  EXPECT_LT(newmarkDifference(), 1000);  // in units of round-off
  EXPECT_EQ(verdict("C10", {}), Verdict::kConfirmed);
}

TEST(Claims, TableForThePage) {
  const auto html = claimsHtml({}, "no/figures");
  EXPECT_TRUE(containsAll(html, {"<table class=\"claims\">", "id=\"C7\"", "not_measurable",
                                 "irk run drift &amp;&amp; irk plot drift"}));
  EXPECT_EQ(html.find("href"), html.npos) << "no link to a figure that does not exist";
}

TEST(Measures, CostsAreComparedAtEqualErrors) {
  Table runs = costColumns({"scene", "method", "norm"});
  addSeries(runs, {{"scene", "kepler"}, {"method", "gauss_3"}, {"norm", "mixed"}}, 1);
  addSeries(runs, {{"scene", "kepler"}, {"method", "gauss_3"}, {"norm", "absolute"}}, 1.5);
  addSeries(runs, {{"scene", "pendulum"}, {"method", "gauss_3"}, {"norm", "absolute"}}, 7);
  const auto ratios = compareCosts(runs, "norm", "mixed", "absolute", "cpu_s");
  ASSERT_EQ(ratios.all.size(), comparedErrors().size());
  for (const double ratio : ratios.all) EXPECT_NEAR(ratio, 1.5, 1e-12);
  // What only one of the two reaches is counted, not compared.
  const Table coarse = where(runs, [&](const TableRow& row) {
    return textAt(runs, row, "norm") == "mixed" || numberAt(runs, row, "error") > 1e-7;
  });
  const auto lost = compareCosts(coarse, "norm", "mixed", "absolute", "cpu_s");
  EXPECT_EQ(lost.all.size(), 5u);  // 1e-2 ... 1e-6
  EXPECT_EQ(lost.lost, 4);
}

TEST(Measures, Statistics) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_TRUE(std::isnan(median({})));
  EXPECT_EQ(part({1, 2, 3, 4}, [](double x) { return x > 1; }), 0.75);
  EXPECT_EQ(graded(1, 1, 2), Verdict::kConfirmed);
  EXPECT_EQ(graded(2, 1, 2), Verdict::kWithinLimits);
  EXPECT_EQ(graded(2.1, 1, 2), Verdict::kContradicted);
  EXPECT_EQ(graded(std::nan(""), 1, 2), Verdict::kNotMeasurable);
}

}  // namespace
}  // namespace irk
