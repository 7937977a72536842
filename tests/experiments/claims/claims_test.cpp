// From measurements to the text and the page.
#include "experiments/claims/claims.h"

#include <gtest/gtest.h>

#include "experiments/claims/claims_html.h"
#include "experiments/claims/claims_text.h"
#include "tests/experiments/claim_tables.h"
#include "tests/experiments/support.h"

namespace irk::claims {
namespace {

Part part() { return {.id = "T1", .name = "test", .measured = "a value", .unit = "times", .confirmed = {.high = 2}}; }

// Twelve cases of three scenes with the value 1, and some of a scene that is no multibody system.
Measurement ones(const ResultTables&, Setting) {
  Measurement measured;
  for (const char* scene : {"a", "b", "c"}) {
    for (int i = 0; i < 4; ++i) measured.cases.push_back({scene, 1});
  }
  for (int i = 0; i < 100; ++i) measured.cases.push_back({"kaps", 9});
  return measured;
}
Measurement missing(const ResultTables& tables, Setting) {
  tables.runs("nothing");
  return {};
}

Finding found(const Part& part, const ResultTables& tables, Evaluation evaluate = ones) {
  return findingOn(part, Setting::kPaper, tables, {"a", "b", "c"}, evaluate);
}

TEST(Claims, OnlyMultibodySystemsVoteOnClaimsAboutThem) {
  Part one = part();
  EXPECT_EQ(found(one, kNoResults).judged.cases, 112u);
  EXPECT_EQ(found(one, kNoResults).judged.value, 9);
  one.multibody_only = true;
  EXPECT_EQ(found(one, kNoResults).judged.cases, 12u);
  EXPECT_EQ(found(one, kNoResults).judged.verdict, Verdict::kConfirmed);
}

TEST(Claims, QuickResultsGiveNoVerdict) {
  Part one = part();
  one.multibody_only = true;
  EXPECT_EQ(found(one, ResultTables("results")).judged.verdict, Verdict::kConfirmed);
  const auto quick = found(one, ResultTables("results/quick"));
  EXPECT_EQ(quick.judged.verdict, Verdict::kNoVerdict);
  EXPECT_EQ(verdictText(quick.judged.verdict), "no verdict (quick)");
  EXPECT_EQ(found(one, ResultTables("results/quick"), missing).judged.verdict, Verdict::kNotMeasurable);
  EXPECT_EQ(quick.judged.value, 1);
  EXPECT_TRUE(containsAll(quick.judged.reason, {"preliminary", "--quick"}));
  EXPECT_TRUE(sensitivityLines(one, quick).empty());
  EXPECT_TRUE(containsAll(claimsText(ResultTables("results/quick")), {"--quick", "no verdicts", "preliminary"}));
}

TEST(Claims, SayWhatIsMissingAndWhatDoesNotApply) {
  EXPECT_EQ(found(part(), kNoResults, missing).judged.verdict, Verdict::kNotMeasurable);
  EXPECT_TRUE(containsAll(found(part(), kNoResults, missing).judged.reason, {"study nothing has not been run"}));
  Part one = part();
  one.not_applied[0] = "no such thing";
  EXPECT_EQ(found(one, kNoResults).judged.verdict, Verdict::kDoesNotApply);
  EXPECT_EQ(found(one, kNoResults).judged.reason, "no such thing");
  EXPECT_EQ(findingOn(one, Setting::kBest, kNoResults, {}, missing).judged.verdict, Verdict::kNotMeasurable);
}

TEST(Claims, WithoutResultsNoneIsJudgedButNewmark) {
  for (const auto& findings : judgeClaims(protocol(), ResultTables{})) {
    for (const Setting setting : kSettings) {
      if (findings.claim->id == "C10" && setting == Setting::kPaper) {
        EXPECT_EQ(findings.verdict(setting), Verdict::kConfirmed);
        continue;
      }
      const Verdict verdict = findings.verdict(setting);
      EXPECT_TRUE(verdict == Verdict::kNotMeasurable || verdict == Verdict::kDoesNotApply) << findings.claim->id;
    }
  }
}

TEST(Claims, Text) {
  const ResultTables nothing;
  EXPECT_TRUE(containsAll(claimsText(nothing), {"  order of Gauss, 10 stages  ", "  factorization over step  ",
                                                "not measurable", "has not been run"}));
  EXPECT_TRUE(
      containsAll(claimsText(nothing, Detail::kSensitivity),
                  {"50% overhead", "(section 5)", "1.35 to 1.65 times", "irk run claims && irk plot claims",
                   "difference to Newmark: largest", "threshold halved (below 500 round-off units): confirmed; doubled",
                   "without duffing: confirmed"}));
  EXPECT_EQ(claimsText(nothing), claimsText(nothing));
}

TEST(Claims, Conditions) {
  EXPECT_EQ(conditionText(part()), "at most 2 times");
  Part one = part();
  one.statistic = Statistic::kShare;
  one.confirmed = {.low = 0.95};
  one.clean = {.high = 4};
  EXPECT_EQ(conditionText(one), "at least 95 % of the cases are at most 4 times");
  EXPECT_EQ(countedText(one), "of the cases are at most 4 times");
  one.yes_or_no = true;
  EXPECT_EQ(conditionText(one), "at least 95 % of the cases show it");
  one.statistic = Statistic::kExistence;
  EXPECT_EQ(conditionText(one), "one case shows it");
  EXPECT_EQ(countedText(part()), "") << "a median counts nothing";
}

TEST(Claims, TableForThePage) {
  const auto html = claimsHtml(ResultTables{}, "no/figures");
  EXPECT_TRUE(containsAll(
      html, {"<table class=\"claims\">", "id=\"C7\"", "verdict not_measurable", "<details", "class=\"history\"",
             "class=\"sensitivity\"", "verdict confirmed", "irk run claims &amp;&amp; irk plot claims"}));
  EXPECT_EQ(html.find("href"), html.npos) << "no link to a figure that does not exist";
  EXPECT_TRUE(containsAll(claimsHtml(ResultTables("results/quick"), "no/figures"), {"<em>preliminary</em>"}));
}

TEST(Measures, ErrorsAreTheLargestOfTenTimes) {
  RunTable runs;
  for (int i = 1; i <= 10; ++i) runs.add({{"t_end", std::to_string(i)}, {"error", i == 4 ? "0.5" : "0.1"}});
  for (int i = 1; i <= 9; ++i) runs.add({{"t_end", std::to_string(i)}, {"rtol", "1e-9"}, {"error", "0.1"}});
  const Table all = overTimes(runs.table(), "s");
  ASSERT_EQ(all.rows.size(), 1u) << "nine times are too few";
  EXPECT_EQ(numberAt(all, all.rows[0], "error"), 0.5);
  EXPECT_EQ(numberAt(all, all.rows[0], "t_end"), 10);
  EXPECT_TRUE(std::isnan(numberAt(all, all.rows[0], "error_u"))) << "not known";
  EXPECT_THROW(overTimes(where(runs.table(), {{"rtol", "1e-9"}}), "s"), MissingResults);
}

// Rows of blocks are read again from the file, wherever they are in it; those of other blocks never.
TEST(Measures, RunsOfAFileAreThoseOfATable) {
  RunTable runs;
  for (int i = 1; i <= 10; ++i) {
    for (const char* block : {"stages_few", "norm_mixed", "stages_many norm_mixed", ""}) {
      for (const char* configuration : {"paper", "variable"}) {
        runs.add({{"block", block},
                  {"configuration", configuration},
                  {"t_end", std::to_string(i)},
                  {"error", text(0.1 * (i * 7 % 10))},
                  {"detail", "of " + std::string(block)}});
      }
    }
  }
  const TemporaryFolder folder;
  writeTable(folder.path() / "results/claims/runs.csv", runs.table());
  const ResultTables in_file(folder.path() / "results"), made_up = runs.results();
  const Blocks blocks = {"norm_mixed"};
  const Table expected = inBlocks(made_up, "claims", blocks), read = inBlocks(in_file, "claims", blocks);
  EXPECT_EQ(expected.rows.size(), 40u);
  EXPECT_EQ(read.rows, expected.rows);
  EXPECT_EQ(read.columns, expected.columns);
  EXPECT_EQ(inBlocks(in_file, "claims", blocks).rows, expected.rows) << "a second time";
  const Table paper = timedRuns(in_file, "claims", blocks, Setting::kPaper);
  EXPECT_EQ(paper.rows, overTimes(inSetting(expected, "claims", Setting::kPaper), "claims").rows);
  ASSERT_EQ(paper.rows.size(), 1u) << "blocks are no part of a run";
  EXPECT_EQ(numberAt(paper, paper.rows[0], "error"), 0.9);
  EXPECT_THROW(inBlocks(ResultTables(folder.path()), "claims", blocks), MissingResults);
}

TEST(Measures, CostsAreComparedAtEqualErrors) {
  RunTable runs;
  runs.addSeries({{"scene", "kepler"}, {"norm", "mixed"}}, 1);
  runs.addSeries({{"scene", "kepler"}, {"norm", "absolute"}}, 1.5);
  runs.addSeries({{"scene", "pendulum"}, {"norm", "absolute"}}, 7);
  const Table table = overTimes(runs.table(), "s");
  const auto ratios = compareCosts(table, "norm", "mixed", "absolute", "cpu_s");
  ASSERT_EQ(ratios.cases.size(), 10u);  // 1e-2 ... 1e-11
  for (const auto& one : ratios.cases) {
    EXPECT_NEAR(one.value, 1.5, 1e-12);
    EXPECT_EQ(one.scene, "kepler");
  }
  const Table coarse = where(table, [&](const TableRow& row) {
    return textAt(table, row, "norm") == "mixed" || numberAt(table, row, "error") > 1e-7;
  });
  const auto lost = compareCosts(coarse, "norm", "mixed", "absolute", "cpu_s");
  EXPECT_EQ(lost.cases.size(), 5u);  // 1e-2 ... 1e-6
  EXPECT_EQ(lost.lost, 5);
}

TEST(Measures, SettingsAreConfigurations) {
  RunTable runs;
  for (const char* configuration : {"default", "paper", "embedded", "variable"}) {
    runs.add({{"configuration", configuration}});
  }
  EXPECT_EQ(inSetting(runs.table(), "s", Setting::kPaper).rows.size(), 1u);
  EXPECT_EQ(inSetting(runs.table(), "s", Setting::kBest).rows.size(), 2u);
  EXPECT_THROW(inSetting(where(runs.table(), {{"configuration", "default"}}), "s", Setting::kBest), MissingResults);
}

}  // namespace
}  // namespace irk::claims
