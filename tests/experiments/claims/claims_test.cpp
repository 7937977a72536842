#include "experiments/claims/claims.h"

#include <gtest/gtest.h>

#include <set>

#include "experiments/report/report.h"
#include "experiments/study/builtin_studies.h"
#include "tests/experiments/claim_tables.h"
#include "tests/experiments/support.h"

namespace irk::claims {
namespace {

TEST(Claims, AreFifteenAndComplete) {
  ASSERT_EQ(claims().size(), 15u);
  std::set<std::string> known;
  for (const auto& study : builtinStudies()) known.emplace(study.id);
  std::set<std::string> figures;
  for (const auto& figure : readFigures(std::filesystem::path(IRK_SOURCE_DIR) / "plots/figures.txt")) {
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

TEST(Claims, QuickResultsGiveNoVerdict) {
  const Claim claim{.id = "C0", .statement = "", .studies = {}, .figures = {}, .evaluate = [](const ResultTables&) {
                      return Finding{Verdict::kConfirmed, "3", "Above 2."};
                    }};
  EXPECT_EQ(judge(claim, ResultTables("results")).verdict, Verdict::kConfirmed);
  const Finding quick = judge(claim, ResultTables("results/quick"));
  EXPECT_EQ(quick.verdict, Verdict::kNotMeasurable);
  EXPECT_EQ(quick.number, "3");
  EXPECT_TRUE(containsAll(quick.reason, {"--quick", "Here: confirmed", "Above 2."}));
  EXPECT_TRUE(containsAll(claimsText(ResultTables("results/quick")), {"--quick", "no verdicts"}));
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

TEST(Claims, TableForThePage) {
  const auto html = claimsHtml(ResultTables{}, "no/figures");
  EXPECT_TRUE(containsAll(
      html, {"<table class=\"claims\">", "id=\"C7\"", "not_measurable", "irk run drift &amp;&amp; irk plot drift"}));
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
  // Errors that only one of the two reaches are counted, not compared.
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
}  // namespace irk::claims
