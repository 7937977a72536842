// The verbs that work on studies, each with success and failure: run, merge, compare, plot, report, claims, paper.
// Each test has its own folder and a study of seconds.
#include <gtest/gtest.h>
#include <csignal>
#include <fstream>
#include <iterator>

#include "experiments/runs/run_table.h"
#include "experiments/study/study.h"
#include "tests/experiments/commands/verbs.h"
#include "tests/experiments/program.h"
#include "tests/experiments/study_runs.h"

namespace irk {
namespace {

TEST_F(Verbs, RunMakesTablesAndAgainKeepsThem) {
  const Ended first = run();
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_TRUE(containsAll(first.out, {"small", "8 runs", "8 success"}));
  const Table table = runs();
  ASSERT_EQ(table.rows.size(), 8u);
  for (const auto& row : table.rows) {
    EXPECT_EQ(textAt(table, row, "outcome"), "success");
    EXPECT_EQ(numberAt(table, row, "cpu_runs"), 2) << "timed";
  }
  EXPECT_TRUE(exists("small/cpu_at_error.csv"));
  ASSERT_EQ(run().status, 0);
  EXPECT_EQ(runs().rows, table.rows);
  ASSERT_EQ(run("results", {"--fresh"}).status, 0);
  EXPECT_NE(runs().rows, table.rows) << "other times";
}

TEST_F(Verbs, RunOfAMistakeIsStatusTwo) {
  std::ofstream(study()) << "title = \"Small\"\n[[block]]\nscene = \"pendulun\"\nmethods = \"gauss_2\"\n";
  const Ended ended = run();
  EXPECT_EQ(ended.status, 2);
  EXPECT_TRUE(containsAll(ended.err, {"pendulun", "'pendulum'"}));
  EXPECT_EQ(program({"run", results("no_such.toml")}).status, 2);
}

TEST_F(Verbs, AFolderThatCannotBeMadeIsStatusTwo) {
  const std::string file = study() + "/results";  // below a file
  expectOneLine({{2, {"run", study(), "--results", file}, file},
                 {2, {"report", "--results", file}, file},
                 {2, {"plot", "drift", "--results", file}, file}});
}

TEST_F(Verbs, OneThreadAndSeveralMakeTheSame) {
  ASSERT_EQ(run("several").status, 0);
  ASSERT_EQ(program({"run", study(), "--results", results("one"), "--jobs", "1"}).status, 0);
  const Ended same = program({"compare", results("one") + "/small", results("several") + "/small", "--times", "1000%"});
  EXPECT_EQ(same.status, 0) << same.out;
  EXPECT_TRUE(containsAll(same.out, {"8 runs and 8 runs: 0 differences"}));
}

// The limits themselves are tested in tests/experiments/compare/compare_test.cpp.
TEST_F(Verbs, CompareSeesADifference) {
  ASSERT_EQ(run().status, 0);
  const auto changed = [&](const std::string& column, const char* cell) {
    Table other = runs();
    other.rows.front()[other.column(column)] = cell;
    const auto folder = std::filesystem::path(results("other")) / "small";
    writeTable(folder / "runs.csv", other);
    // Times are compared within a timing class only.
    writeTable(folder / "environments.csv", readTable(std::filesystem::path(results()) / "small" / "environments.csv"));
    return program({"compare", results() + "/small", results("other") + "/small"});
  };
  for (const auto* column : {"error", "error_v", "drift", "residuals", "outcome", "steps_accepted", "cpu_s"}) {
    const Ended ended = changed(column, "123");
    EXPECT_EQ(ended.status, 1) << column;
    EXPECT_TRUE(containsAll(ended.out, {"8 runs and 8 runs: 1 differences", "pendulum"})) << column;
  }
  for (const auto* column : {"key", "detail", "cpu_median_s", "cpu_spread"}) {
    EXPECT_EQ(changed(column, "123").status, 0) << column;
  }
  Table fewer = runs();
  fewer.rows.pop_back();
  writeTable(std::filesystem::path(results("other")) / "small" / "runs.csv", fewer);
  EXPECT_EQ(program({"compare", results() + "/small", results("other") + "/small"}).status, 1);
  EXPECT_EQ(program({"compare", results("other") + "/small", results() + "/small"}).status, 1);
  EXPECT_EQ(program({"compare", results() + "/small", results("nowhere")}).status, 2);
}

}  // namespace
}  // namespace irk
