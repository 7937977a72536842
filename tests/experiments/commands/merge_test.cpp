#include <gtest/gtest.h>
#include <algorithm>
#include <csignal>
#include <fstream>
#include <iterator>
#include <sstream>

#include "experiments/runs/run_table.h"
#include "experiments/study/study.h"
#include "tests/experiments/commands/verbs.h"
#include "tests/experiments/program.h"
#include "tests/experiments/study_runs.h"

namespace irk {
namespace {

TEST_F(Verbs, MergeJoinsShardsToTheWhole) {
  ASSERT_EQ(run("whole").status, 0);
  ASSERT_EQ(run("parts", {"--shard", "1/2"}).status, 0);
  ASSERT_EQ(run("parts", {"--shard", "2/2"}).status, 0);
  const std::string parts = results("parts") + "/small/shard_";
  const Table one = readTable(parts + "1_of_2/runs.csv"), two = readTable(parts + "2_of_2/runs.csv");
  EXPECT_EQ(one.rows.size() + two.rows.size(), 8u);
  EXPECT_FALSE(one.rows.empty() || two.rows.empty());
  const Ended merged =
      program({"merge", parts + "2_of_2", parts + "1_of_2", "--study", study(), "--results", results("merged")});
  ASSERT_EQ(merged.status, 0) << merged.err;
  EXPECT_TRUE(containsAll(merged.out, {"small", "8 runs of 2 folders"}));
  EXPECT_TRUE(std::filesystem::exists(results("merged") + "/small/cpu_at_error.csv"));
  const Ended same =
      program({"compare", results("whole") + "/small", results("merged") + "/small", "--times", "1000%"});
  EXPECT_EQ(same.status, 0) << same.out;
  // Runs are in the order of the study, regardless of the order of the folders.
  const Table a = runs("whole"), b = runs("merged");
  for (std::size_t i = 0; i < a.rows.size(); ++i) EXPECT_EQ(a.rows[i].front(), b.rows[i].front());
}

TEST_F(Verbs, MergePrefersTimedRowsAndMatchesColumnsByName) {
  ASSERT_EQ(run().status, 0);
  Table timed = readPartTable(partsOf(results() + "/small").front()), untimed = timed;
  for (auto& row : untimed.rows) {
    row[untimed.column("cpu_runs")] = "0";
    row[untimed.column("cpu_s")] = "77";
    row[untimed.column("date")] = "2099-01-01T00:00:00Z";
  }
  const std::string a = results("a"), b = results("b");
  const auto part = std::filesystem::path("parts") / "runs.0001.host.1.csv";
  writePartTable(a / part, timed);
  writePartTable(b / part, untimed);
  for (const auto& order : {std::vector{a, b}, std::vector{b, a}}) {
    const std::string into = results(order[0] == a ? "m" : "n");
    const Ended merged = program({"merge", order[0], order[1], "--study", study(), "--results", into});
    ASSERT_EQ(merged.status, 0) << merged.err;
    EXPECT_TRUE(containsAll(merged.out, {"expected 8, found 8, missing 0, duplicate 8"}));
    for (const auto& row : readTable(into + "/small/runs.csv").rows) EXPECT_NE(row[timed.column("cpu_s")], "77");
  }
  timed.columns.back() = "another";
  writePartTable(a / part, timed);
  const Ended refused = program({"merge", a, "--study", study(), "--results", results("o")});
  EXPECT_EQ(refused.status, 2);
  EXPECT_TRUE(containsAll(refused.err, {"columns", "no run of this version"}));
}

TEST_F(Verbs, MergeNamesMissingRuns) {
  ASSERT_EQ(run("parts", {"--shard", "2/3"}).status, 0);
  const std::string shard = results("parts") + "/small/shard_2_of_3";
  std::vector<std::string> arguments{"merge", shard, "--study", study(), "--results", results("merged")};
  const Ended missing = program(arguments);
  EXPECT_EQ(missing.status, 1);
  EXPECT_TRUE(containsAll(
      missing.out, {"expected 8, found 2, missing 6", " run " + study() + " --shard 1/3 --results " + results("parts"),
                    " run " + study() + " --shard 3/3 --results " + results("parts")}));
  EXPECT_EQ(missing.out.find("--shard 2/3"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(results("merged") + "/small/runs.csv"));
  arguments.emplace_back("--partial");
  EXPECT_EQ(program(arguments).status, 0);
  EXPECT_EQ(runs("merged").rows.size(), 2u);
  // Merged rows count: the remaining runs are made in the folder with the merged ones.
  EXPECT_EQ(run("merged").status, 0);
  EXPECT_EQ(runs("merged").rows.size(), 8u);
}

// The printed commands, executed without change, make the missing runs.
TEST_F(Verbs, MergePrintsCommandsThatWork) {
  std::vector<std::string> arguments{"run", study(), "--quick", "--results", results("parts"), "--shard", "1/2"};
  ASSERT_EQ(program(arguments).status, 0);
  const auto merged = [&](std::vector<std::string> more) {
    std::vector<std::string> merge{
        "merge",          results("parts") + "/quick/small/shard_1_of_2", "--study", study(), "--quick", "--results",
        results("merged")};
    merge.insert(merge.end(), more.begin(), more.end());
    return program(merge);
  };
  const Ended missing = merged({});
  ASSERT_EQ(missing.status, 1);
  const auto at = missing.out.find("  /");
  ASSERT_NE(at, std::string::npos) << missing.out;
  std::istringstream command(missing.out.substr(missing.out.find(" run ", at)));  // behind the program's path
  arguments.clear();
  for (std::string word; command >> word;) arguments.push_back(word);
  ASSERT_EQ(program(arguments).status, 0) << missing.out;
  const Ended whole = merged({results("parts") + "/quick/small/shard_2_of_2"});
  EXPECT_EQ(whole.status, 0) << whole.out;
  EXPECT_EQ(readTable(results("merged") + "/quick/small/runs.csv").rows.size(), 8u);
}

TEST_F(Verbs, MergeRefusesTwoStudies) {
  ASSERT_EQ(run().status, 0);
  const std::string other = folder_.path() / "other.toml";
  std::ofstream(other) << kSmall;
  ASSERT_EQ(program({"run", other, "--results", results()}).status, 0);
  const Ended ended = program({"merge", results() + "/small", results() + "/other", "--study", study()});
  EXPECT_EQ(ended.status, 2);
  EXPECT_TRUE(containsAll(ended.err, {"two studies", "'small'", "'other'"}));
  const Ended itself = program({"merge", results() + "/small", "--study", study(), "--results", results()});
  EXPECT_EQ(itself.status, 2);
  EXPECT_TRUE(containsAll(itself.err, {"merged there", "leave it out"}));
}

}  // namespace
}  // namespace irk
