// Shards of a study for array jobs.
#include "experiments/runner/shards.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <numeric>

#include "experiments/runner/schedule/costs.h"
#include "experiments/study/study_reader.h"
#include "tests/experiments/program.h"
#include "tests/experiments/stored_runs.h"

namespace irk {
namespace {

/// Sets a variable of the environment; the destructor restores it.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) { setenv(name, value, 1); }
  ~Variable() { unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
};

TEST(Shards, AreReadFromTheOptionAndTheArrayJob) {
  EXPECT_EQ(parseShard("2/3").index, 2);
  EXPECT_EQ(parseShard("2/3").count, 3);
  EXPECT_TRUE(containsAll(misuseOf([] { parseShard("4/3"); }), {"shard", "4", "3"}));
  EXPECT_TRUE(containsAll(misuseOf([] { parseShard("half"); }), {"shard", "half", "i/n"}));
  EXPECT_TRUE(containsAll(misuseOf([] { parseShard("auto/3"); }), {"no array job", "SLURM_ARRAY_TASK_ID"}));
  {
    const Variable index("SGE_TASK_ID", "5");
    EXPECT_EQ(parseShard("auto/7").index, 5);
    EXPECT_TRUE(containsAll(misuseOf([] { parseShard("auto"); }), {"auto/n"}));
    EXPECT_TRUE(containsAll(misuseOf([] { parseShard("auto/4"); }), {"5", "4"}));
  }
  const Variable index("SLURM_ARRAY_TASK_ID", "0"), first("SLURM_ARRAY_TASK_MIN", "0"),
      count("SLURM_ARRAY_TASK_COUNT", "8");
  EXPECT_EQ(parseShard("auto").index, 1);
  EXPECT_EQ(parseShard("auto").count, 8);
}

constexpr char kUneven[] = R"(
[[block]]
scene = ["kepler", "slider_crank"]
families = ["radau_iia", "gauss"]
stages = ["2..13"]
tolerances = [1e-4, 1e-9]
)";

// The bound of the greedy rule: no shard has more than the mean plus the longest series.
TEST(Shards, AreOfAboutTheSameExpectedCost) {
  const Study study = parseStudy(kUneven, "uneven.toml", StudyVariant::kFull);
  std::vector<double> cost;
  for (const auto& series : study.series) cost.push_back(expectedCost(series));
  const double total = std::accumulate(cost.begin(), cost.end(), 0.0);
  const double largest = *std::max_element(cost.begin(), cost.end());
  for (const int n : {1, 2, 3, 7, 16}) {
    const auto shard = shardsOf(study, n);
    ASSERT_EQ(shard.size(), study.series.size());
    std::vector<double> load(static_cast<std::size_t>(n));
    for (std::size_t i = 0; i < shard.size(); ++i) {
      ASSERT_GE(shard[i], 1);
      ASSERT_LE(shard[i], n);
      load[static_cast<std::size_t>(shard[i] - 1)] += cost[i];
    }
    EXPECT_GT(*std::min_element(load.begin(), load.end()), 0) << n;
    EXPECT_LE(*std::max_element(load.begin(), load.end()), total / n + largest) << n;
  }
}

TEST(Shards, LongerSeriesCostMore) {
  const auto costOf = [](const std::string& method, const std::string& tolerances) {
    const std::string toml =
        "[[block]]\nscene = \"kepler\"\nmethods = [\"" + method + "\"]\ntolerances = [" + tolerances + "]\n";
    return expectedCost(parseStudy(toml, "one.toml", StudyVariant::kFull).series.front());
  };
  EXPECT_GT(costOf("gauss_3", "1e-9"), costOf("gauss_3", "1e-4"));
  EXPECT_GT(costOf("gauss_3", "1e-4, 1e-5"), costOf("gauss_3", "1e-5"));
  EXPECT_GT(costOf("gauss_12", "1e-4"), costOf("gauss_6", "1e-4"));
}

// Runs the printed script as Slurm would, from another folder and without a PATH, and joins the results with the
// command that it names. Names have blanks and what a shell would run.
TEST(Shards, SlurmScriptRunsAsWritten) {
  const TemporaryFolder folder;
  const std::string path = folder.path().string();
  const std::string odd = "my $(touch hacked) 'study'";
  std::filesystem::create_directories(folder.path() / odd);
  std::ofstream(folder.path() / odd / "small.toml") << kToml;
  const auto bash = [&](const std::string& command) {
    std::ofstream(path + "/step.sh") << "set -eu\ncd " << path << '\n' << command << '\n';
    return std::system(("env -i /bin/bash " + path + "/step.sh > " + path + "/log 2>&1").c_str());
  };
  const std::string irk = IRK_PROGRAM, in_odd = "cd \"my \\$(touch hacked) 'study'\"; ";
  ASSERT_EQ(bash(in_odd + irk + " slurm small.toml -n 3 --results 'my results' > ../job.sh"), 0);
  ASSERT_EQ(bash("for i in 1 2 3; do SLURM_ARRAY_TASK_ID=$i /bin/bash job.sh; done"), 0)
      << readInputFile(path + "/log");
  ASSERT_EQ(bash("eval \"$(/bin/sed -n 's/^#   //p' job.sh)\""), 0) << readInputFile(path + "/log");
  ASSERT_EQ(bash(in_odd + irk + " run small.toml --results ../whole"), 0);
  expectSame(readTable(folder.path() / odd / "my results" / "small" / "runs.csv"),
             readTable(folder.path() / "whole" / "small" / "runs.csv"));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path())) {
    EXPECT_NE(entry.path().filename(), "hacked");
  }
  EXPECT_NE(bash(in_odd + irk + " slurm small.toml -n 400"), 0);
}

// The name of a study file stands in comments of the script, too.
TEST(Shards, NoNameEndsALineOfTheScript) {
  const TemporaryFolder folder;
  const std::string name = folder.path() / "a\necho hacked\n'.toml";
  std::ofstream(name) << kToml;
  const Ended script = program({"slurm", name, "-n", "2"});
  ASSERT_EQ(script.status, 0) << script.err;
  std::istringstream lines(script.out);
  int commands = 0;
  for (std::string line; std::getline(lines, line);) commands += line.starts_with('#') ? 0 : 1;
  EXPECT_EQ(commands, 1) << script.out;
  EXPECT_TRUE(containsAll(script.out, {"$'", "\\x0aecho hacked\\x0a\\'.toml'"}));
}

}  // namespace
}  // namespace irk
