#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "experiments/report/answers/failures.h"
#include "experiments/report/answers/paper.h"
#include "experiments/report/answers/solvers.h"
#include "experiments/report/answers/study_answers.h"
#include "tests/experiments/claim_tables.h"
#include "tests/experiments/report/answer_tables.h"
#include "tests/experiments/support.h"

namespace irk::report {
namespace {

const double kNever = std::numeric_limits<double>::infinity();
const double kNone = std::numeric_limits<double>::quiet_NaN();

TEST(Ranking, PrefersWhoSolvesMoreThenWhoIsFaster) {
  const SolverCosts costs{{"sure", {{"p1", 4}, {"p2", 4}}},
                          {"fast", {{"p1", 1}, {"p2", kNever}}},
                          {"slow", {{"p1", 8}, {"p2", 8}}},
                          {"never", {{"p1", kNever}}}};
  const auto ranked = ranking(costs);
  ASSERT_EQ(ranked.size(), 3u) << "a solver without a solved problem has no place";
  EXPECT_EQ(ranked[0].solver, "sure");
  EXPECT_EQ(ranked[1].solver, "slow");
  EXPECT_EQ(ranked[2].solver, "fast");
  EXPECT_EQ(ranked[2].solved, 1);
  EXPECT_EQ(ranked[2].given, 2);
  EXPECT_NEAR(ranked[0].factor, 2, 1e-12) << "4 over 1 and 4 over 4: geometric mean";
  EXPECT_NEAR(ratio(costs, "slow", "sure"), 2, 1e-12);
  EXPECT_NEAR(ratio(costs, "fast", "sure"), 0.25, 1e-12) << "of the problem that both solve";
  EXPECT_TRUE(std::isnan(ratio({{"sure", {{"p1", 4}, {"p2", 4}, {"p3", 4}}}, {"fast", {{"p1", 1}}}}, "fast", "sure")))
      << "fewer than half";
  EXPECT_TRUE(std::isnan(ratio(costs, "never", "sure")));
  EXPECT_TRUE(std::isnan(ratio(costs, "unknown", "sure")));
  EXPECT_EQ(solvable(costs), 2);
  EXPECT_EQ(wins(costs).at("sure"), 1);
  EXPECT_EQ(wins(costs).at("fast"), 1);
}

// A problem that nobody solves counts for nobody.
TEST(Ranking, LeavesOutWhatNobodySolves) {
  const SolverCosts costs{{"a", {{"p1", 1}, {"hard", kNever}}}, {"b", {{"p1", 2}, {"hard", kNever}}}};
  EXPECT_EQ(solvable(costs), 1);
  EXPECT_EQ(ranking(costs)[0].given, 1);
  EXPECT_TRUE(ranking({{"a", {{"hard", kNever}}}}).empty());
}

TEST(Ranking, ComparesTheSecondBest) {
  const Ranked best{"best", 4, 4, 1}, next{"next", 4, 4, 2}, partial{"partial", 2, 3, 1};
  EXPECT_EQ(comparison(2, best, next, 4), "2.0 times as fast as `next`");
  EXPECT_EQ(comparison(1.05, best, next, 4), "as fast as `next`");
  EXPECT_EQ(comparison(0.5, best, partial, 4),
            "2.0 times as slow as `partial`, which solves 2 of 4 and was not asked for so small an error in 1");
  EXPECT_EQ(comparison(kNone, best, partial, 4),
            "no ratio: too few problems in common with the best other library's solver, `partial`, which solves 2 of 4 "
            "and was not asked for so small an error in 1");
  EXPECT_EQ(comparison(1, best, {}, 4), "no other reaches this error");
}

// Two solvers of the suite and one of another library on one stiff and one switched problem.
claims::ResultTables solverTables(double library_time = 4, const char* library = "cvode_bdf") {
  const std::vector<std::string> columns{"scene", "settings", "integrator", "target_error", "cpu_s", "cause", "block"};
  const auto cost = [](const char* scene, const char* solver, const char* error, const std::string& time,
                       const char* block, const char* cause = "") {
    return Cells{{"scene", scene}, {"integrator", solver}, {"target_error", error},
                 {"cpu_s", time},  {"cause", cause},       {"block", block}};
  };
  claims::ResultTables tables;
  tables.put(
      "work_precision", "cpu_at_error",
      tableOf(columns, {cost("robertson", "variable", "1e-8", "1", "ivp_variable"),
                        cost("robertson", "embedded:radau_iia_5", "1e-8", "2", "ivp_embedded"),
                        cost("robertson", library, "1e-8", std::to_string(library_time), "ivp_peers"),
                        cost("robertson", "ida_bdf", "1e-8", "nan", "ivp_peers", "not accurate enough"),
                        cost("hires", "cvode_bdf", "1e-8", "nan", "ivp_peers", "no reference"),
                        cost("stick_slip", "variable", "1e-8", "nan", "switching_variable", "no success: timeout"),
                        cost("robertson", "variable", "1e-11", "3", "ivp_variable")}));
  const auto run = [](const char* solver, const char* outcome, const char* error, const char* block) {
    return Cells{{"integrator", solver}, {"outcome", outcome}, {"rtol", "1e-8"},   {"atol", "1e-8"},
                 {"error_u", "nan"},     {"error_v", "nan"},   {"error_x", error}, {"block", block}};
  };
  tables.put(
      "work_precision", "runs",
      tableOf({"integrator", "outcome", "rtol", "atol", "error_u", "error_v", "error_x", "block"},
              {run("variable", "success", "1e-6", "ivp_variable"), run("variable", "success", "1e-3", "ivp_variable"),
               run("variable", "max_steps", "nan", "ivp_variable"),
               run("variable", "timeout", "nan", "switching_variable")}));
  return tables;
}

TEST(SolverAnswer, NamesTheFastestByKindAndError) {
  const Answer answer = solverAnswer(solverTables());
  ASSERT_EQ(answer.table.rows.size(), 4u) << "two kinds, two errors";
  EXPECT_EQ(cell(answer.table, 0, "kind"), "ivp");
  EXPECT_EQ(cell(answer.table, 0, "solver"), "variable");
  EXPECT_EQ(cell(answer.table, 0, "problems"), "1") << "a problem without a reference does not count";
  EXPECT_EQ(cell(answer.table, 0, "as_good"), "") << "the next one takes twice as long";
  EXPECT_EQ(cell(answer.table, 0, "library"), "cvode_bdf");
  EXPECT_EQ(cell(answer.table, 0, "over_library"), "4");
  EXPECT_EQ(cell(answer.table, 0, "runs"), "3");
  EXPECT_EQ(cell(answer.table, 0, "failed"), "1");
  EXPECT_EQ(cell(answer.table, 0, "wrong"), "1");
  EXPECT_EQ(cell(answer.table, 2, "kind"), "switching");
  EXPECT_EQ(cell(answer.table, 2, "solver"), "") << "nobody reaches the error";
  EXPECT_TRUE(
      containsAll(answer.sentences.at(0), {"For an error of 1e-8", "`variable` for the IVP test set",
                                           "4.0 times as fast as `cvode_bdf`", "no solver for systems with switches"}));
}

// A solver that was given larger tolerances only is not said to fail, and an error that nobody was asked for is not
// said to be reached by nobody.
TEST(SolverAnswer, CountsWhoWasAskedForTheError) {
  const auto cost = [](const char* scene, const char* solver, const char* error, const char* time, const char* least) {
    const bool reached = std::string_view(time) != "nan";
    return Cells{{"scene", scene},
                 {"integrator", solver},
                 {"target_error", error},
                 {"cpu_s", time},
                 {"least_tolerance", least},
                 {"cause", reached ? "" : "not accurate enough"},
                 {"reached", reached ? "1" : "0"},
                 {"block", "ivp_all"}};
  };
  claims::ResultTables tables = solverTables();
  tables.put(
      "work_precision", "cpu_at_error",
      tableOf(
          {"scene", "settings", "integrator", "target_error", "cpu_s", "least_tolerance", "cause", "reached", "block"},
          {cost("robertson", "variable", "1e-8", "1", "1e-10"), cost("hires", "variable", "1e-8", "1", "1e-10"),
           cost("robertson", "cvode_bdf", "1e-8", "3", "1e-8"), cost("hires", "cvode_bdf", "1e-8", "nan", "1e-6"),
           cost("robertson", "variable", "1e-11", "nan", "1e-10")}));
  const Answer answer = solverAnswer(tables);
  ASSERT_EQ(answer.table.rows.size(), 1u) << "no row for 1e-11";
  EXPECT_EQ(cell(answer.table, 0, "solver"), "variable");
  EXPECT_NEAR(numberAt(answer.table, answer.table.rows[0], "over_library"), 3, 1e-12);
  EXPECT_TRUE(
      containsAll(answer.sentences.at(0), {"which solves 1 of 2 and was not asked for so small an error in 1"}));
}

// The other side: another library is faster.
TEST(SolverAnswer, NamesAnotherLibraryIfThatIsFaster) {
  const Answer answer = solverAnswer(solverTables(0.5));
  EXPECT_EQ(cell(answer.table, 0, "solver"), "cvode_bdf");
  EXPECT_EQ(cell(answer.table, 0, "library"), "") << "it is the best one itself";
}

// A solver that the user gave to the study is in no catalogue when the page is made.
TEST(SolverAnswer, ComparesWithSolversThatWereGiven) {
  const Answer answer = solverAnswer(solverTables(3, "my_radau"));
  EXPECT_EQ(cell(answer.table, 0, "library"), "my_radau");
  EXPECT_TRUE(containsAll(answer.sentences.at(0), {"3.0 times as fast as `my_radau`", "that took part, `cvode_bdf`, ",
                                                   "`ida_bdf`, `my_radau`."}));
  EXPECT_EQ(cell(solverAnswer(solverTables(0.5, "my_radau")).table, 0, "library"), "") << "it is the best one itself";
}

// Times that differ by less than 15 % are equal.
TEST(SolverAnswer, NamesAllThatAreAsGood) {
  EXPECT_EQ(cell(solverAnswer(solverTables(1.1)).table, 0, "as_good"), "cvode_bdf");
  EXPECT_EQ(cell(solverAnswer(solverTables(1.2)).table, 0, "as_good"), "");
  EXPECT_TRUE(containsAll(solverAnswer(solverTables(1.1)).sentences.at(0), {"`variable` or `cvode_bdf` for the IVP"}));
}

TEST(SolverAnswer, SaysWhichStudyIsMissing) {
  const Answer answer = solverAnswer(claims::ResultTables{});
  EXPECT_TRUE(answer.table.columns.empty());
  EXPECT_TRUE(containsAll(answer.sentences.at(0), {"Not known yet", "irk run work_precision"}));
}

Cells run(const char* solver, const char* scene, const char* outcome, const char* error = "1e-9") {
  return {{"integrator", solver}, {"scene", scene},   {"outcome", outcome}, {"rtol", "1e-6"},
          {"atol", "1e-6"},       {"error_u", "nan"}, {"error_v", "nan"},   {"error_x", error}};
}

claims::ResultTables ended(const std::vector<Cells>& rows) {
  return claims::resultsOf(
      "work_precision", "runs",
      tableOf({"integrator", "scene", "outcome", "rtol", "atol", "error_u", "error_v", "error_x"}, rows));
}

TEST(FailureAnswer, ComparesSolversOnTheSameProblems) {
  std::vector<Cells> rows;
  for (int i = 0; i < 8; ++i) rows.push_back(run("variable", "hires", "success"));
  for (int i = 0; i < 2; ++i) rows.push_back(run("variable", "pump", "max_steps"));
  for (int i = 0; i < 4; ++i) rows.push_back(run("cvode_bdf", "hires", "success"));
  for (int i = 0; i < 3; ++i) rows.push_back(run("cvode_bdf", "hires", "success", "0.1"));  // above 1000 tolerances
  rows.push_back(run("cvode_bdf", "pump", "timeout"));
  rows.push_back(run("cvode_bdf", "pump", "refused"));
  claims::ResultTables tables = ended(rows);
  tables.put("audit", "audit_summary",
             tableOf({"by", "group", "right", "wrong"}, {{{"by", "all"}, {"right", "17"}, {"wrong", "1"}}}));
  const Answer answer = failureAnswer(tables);
  EXPECT_TRUE(containsAll(answer.sentences.at(0), {"2 solvers", "of 18 runs, 3 say that they fail, and 3 call"}));
  EXPECT_EQ(answer.sentences.at(1),
            "The most reliable is `variable`: 20 % of its runs fail and 0 % are wrong. The least reliable is "
            "`cvode_bdf`: 12 % of its runs fail and 38 % are wrong.");
  EXPECT_TRUE(containsAll(answer.sentences.at(2), {"pump (100 %) and hires (20 %)"}));
  EXPECT_TRUE(containsAll(answer.sentences.at(3), {"18 successes of the audit", "1 are wrong"}));
  ASSERT_EQ(answer.table.rows.size(), 2u);
  EXPECT_EQ(cell(answer.table, 0, "solver"), "cvode_bdf") << "the least reliable one first";
  EXPECT_EQ(cell(answer.table, 0, "wrong"), "3");
  EXPECT_EQ(cell(answer.table, 0, "timeout"), "1");
  EXPECT_EQ(cell(answer.table, 1, "failed"), "2");
  EXPECT_EQ(answer.shown.rows.at(1).cells.back(), "too many steps (2)");
}

TEST(FailureAnswer, NamesAllThatAreEquallyReliable) {
  std::vector<Cells> rows;
  for (const char* solver : {"default", "variable", "ida"}) {
    for (int i = 0; i < 4; ++i) rows.push_back(run(solver, "hires", "success"));
    rows.push_back(run(solver, "pump", "success", std::string_view(solver) == "ida" ? "0.1" : "1e-9"));
  }
  EXPECT_EQ(failureAnswer(ended(rows)).sentences.at(1),
            "The most reliable are `default` and `variable`: 0 % of the runs of each fail or are wrong. The least "
            "reliable is `ida`: 0 % of its runs fail and 20 % are wrong.");
}

TEST(FailureAnswer, SaysThatNothingFails) {
  const Answer answer = failureAnswer(ended({run("variable", "hires", "success")}));
  EXPECT_TRUE(containsAll(answer.sentences.at(0), {"of 1 runs, 0 say that they fail, and 0 call"}));
  EXPECT_EQ(answer.sentences.size(), 1u);
  EXPECT_TRUE(containsAll(failureAnswer(claims::ResultTables{}).sentences.at(0), {"Not known yet"}));
}

TEST(PaperAnswer, CountsVerdictsAndListsClaims) {
  const Answer answer =
      paperAnswer(std::vector<ClaimVerdicts>{{"C1", "order 20", {"confirmed", "undecided"}},
                                             {"C2", "ten stages", {"contradicted", "confirmed"}, {true, false}},
                                             {"C3", "half as much", {"confirmed", "confirmed"}}});
  EXPECT_EQ(answer.sentences.at(0),
            "Of 3 claims, in the setting that the paper describes: 2 confirmed and 1 contradicted.");
  EXPECT_EQ(answer.sentences.at(1), "Confirmed there: order 20 (C1); half as much (C3).");
  EXPECT_EQ(answer.sentences.at(2), "Contradicted there: ten stages (C2, but a part holds).");
  EXPECT_EQ(answer.sentences.at(3), "With the suite's own best settings: 2 confirmed and 1 undecided.");
  ASSERT_EQ(answer.table.rows.size(), 3u);
  EXPECT_EQ(answer.table.rows[0], (TableRow{"confirmed", "2", "C1 C3", "2", "C2 C3"}));
  EXPECT_EQ(answer.table.rows[2], (TableRow{"undecided", "0", "", "1", "C1"}));
  EXPECT_EQ(answer.shown.rows[1].cells.at(2), "<a href=\"#C2\">C2</a>");
}

TEST(StudyAnswers, CompareTheColumnOfTheStudy) {
  const std::vector<std::string> columns{"scene", "settings", "family", "target_error", "cpu_s", "cause"};
  const auto tables = claims::resultsOf(
      "families", "cpu_at_error",
      tableOf(columns, {{{"scene", "a"}, {"family", "gauss"}, {"target_error", "1e-6"}, {"cpu_s", "3"}},
                        {{"scene", "a"}, {"family", "gauss"}, {"target_error", "1e-6"}, {"cpu_s", "6"}},
                        {{"scene", "a"}, {"family", "radau_iia"}, {"target_error", "1e-6"}, {"cpu_s", "1"}},
                        {{"scene", "a"}, {"family", "gauss"}, {"target_error", "1e-9"}, {"cpu_s", "0.1"}}}));
  const auto sentences = studyAnswers("families", tables);
  ASSERT_EQ(sentences.size(), 1u);
  EXPECT_EQ(
      sentences[0],
      "At an error of 1e-6, the family `radau_iia` is the cheapest: it reaches the error in 1 of 1 problems, is the "
      "fastest in 1, and 3.0 times as fast as `gauss`.");
  EXPECT_TRUE(studyAnswers("peers", tables).empty()) << "no results, no answer";
}

TEST(StudyAnswers, NameTheFastestBySceneWhereTheyAreFew) {
  const std::vector<std::string> columns{"scene", "settings", "family", "target_error", "cpu_s", "cause"};
  const auto tables = claims::resultsOf(
      "families", "cpu_at_error",
      tableOf(columns, {{{"scene", "a"}, {"family", "gauss"}, {"target_error", "1e-6"}, {"cpu_s", "3"}},
                        {{"scene", "a"}, {"family", "radau_iia"}, {"target_error", "1e-6"}, {"cpu_s", "1"}},
                        {{"scene", "b"}, {"family", "gauss"}, {"target_error", "1e-6"}, {"cpu_s", "2"}},
                        {{"scene", "b"}, {"family", "radau_iia"}, {"target_error", "1e-6"}, {"cpu_s", "4"}}}));
  EXPECT_EQ(studyAnswers("families", tables).at(1), "The fastest there by scene: `radau_iia` on a and `gauss` on b.");
}

TEST(StudyAnswers, GiveTheMedianDriftOfCommonSuccesses) {
  claims::ResultTables tables;
  const auto drifted = [](const char* formulation, const char* scene, const char* outcome, const char* drift) {
    return Cells{{"formulation", formulation}, {"scene", scene}, {"outcome", outcome}, {"drift", drift}};
  };
  tables.put("drift", "runs",
             tableOf({"formulation", "scene", "outcome", "drift"},
                     {drifted("index2", "a", "success", "1e-6"), drifted("index2", "b", "success", "3e-6"),
                      drifted("index2", "c", "success", "9e-6"), drifted("index2", "d", "success", "1"),
                      drifted("ggl", "a", "success", "1e-12"), drifted("ggl", "b", "success", "1e-13"),
                      drifted("ggl", "c", "success", "1e-14"), drifted("ggl", "d", "timeout", "1")}));
  EXPECT_EQ(studyAnswers("drift", tables).at(0),
            "The median drift of the 3 runs that succeed with every formulation: 1e-13 with `ggl` and 3e-06 with "
            "`index2`.");
}

TEST(StudyAnswers, CountOutcomes) {
  EXPECT_EQ(outcomeSentence(tableOf({"outcome"}, {{{"outcome", "success"}}, {{"outcome", "drift"}}})),
            "2 runs, 1 successful; the others: drift (1).");
  EXPECT_EQ(outcomeSentence(tableOf({"outcome"}, {{{"outcome", "success"}}})), "1 runs, 1 successful.");
}

}  // namespace
}  // namespace irk::report
