// Times that are measured on several cores at once: the same rows, no lost run, a cause for each that has no times.
#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/analyses/results.h"
#include "experiments/base/interrupt.h"
#include "experiments/runner/cores/processors.h"
#include "experiments/tables/environment.h"
#include "tests/experiments/program.h"
#include "tests/experiments/runner/timed_study.h"
#include "tests/experiments/shared_count.h"

namespace irk {
namespace {

// The second block has a run of the first one again.
constexpr char kTwoBlocks[] = R"(
[timing]
min_time_s = 1e-4
repetitions = 3
[[block]]
scene = "pendulum"
t_end = 0.5
methods = ["radau_iia_2", "radau_iia_3"]
tolerances = [1e-3, 1e-4, 1e-5]
[[block]]
scene = "pendulum"
t_end = 0.5
methods = "radau_iia_3"
tolerances = [1e-4]
)";

class TimedAtOnce : public testing::Test, public TimedStudy {
 protected:
  TimedAtOnce() : TimedStudy(kTwoBlocks) {}
  void SetUp() override {
    if (cores::physicalCores().size() < 2) GTEST_SKIP() << "this process may use one core only";
  }
  Table timeOn(int cores, const TimeCall& time_call = timeCall) {
    return time({.host = 0, .hosts = 1, .cores = cores}, time_call);
  }
  static std::vector<std::string> columnOf(const Table& table, std::string_view column) {
    std::vector<std::string> cells;
    for (const auto& row : table.rows) cells.push_back(textAt(table, row, column));
    return cells;
  }
};

TEST_F(TimedAtOnce, RowsAreThoseOfOneCoreExceptForTimes) {
  const Table after = timeOn(2);
  ASSERT_EQ(after.rows.size(), 6u);
  for (std::size_t i = 0; i < after.rows.size(); ++i) {
    for (const auto& column : after.columns) {
      if (column.starts_with("cpu_") || column == "date") continue;
      EXPECT_EQ(textAt(after, after.rows[i], column), textAt(made, made.rows[i], column)) << column;
    }
    EXPECT_EQ(numberAt(after, after.rows[i], "cpu_runs"), 3);
    EXPECT_GT(numberAt(after, after.rows[i], "cpu_s"), 1e-6);
    EXPECT_GT(numberAt(after, after.rows[i], "cpu_setup_s"), 0);
  }
  EXPECT_TRUE(containsAll(told.str(), {"small timing: 2 of", "at once", "18 runs made"})) << told.str();
  EXPECT_GE(readTable(folder.path() / "small/calibrations.csv").rows.size(), 1u);
}

TEST_F(TimedAtOnce, EachCallHasAProcessOfItsOwn) {
  const Table after = timeOn(2, [](const auto&, double) { return static_cast<double>(getpid()); });
  std::set<std::string> processes;
  for (const auto& cell : columnOf(after, "cpu_all")) {
    std::istringstream in(cell);
    for (std::string process; in >> process;) processes.insert(process);
  }
  EXPECT_EQ(processes.size(), 6u) << "each longer than 0.5 s, and measured once";
  EXPECT_FALSE(processes.contains(std::to_string(getpid())));
}

// One run at a time has threads of its own and is not confined to one core.
TEST_F(TimedAtOnce, ARunOnSeveralThreadsIsMeasuredAloneInThisProcess) {
  study = parseStudy(
      "[timing]\nrepetitions = 1\n[[block]]\nscene = \"beam_chain\"\nsettings = \"m=200\"\nt_end = 1e-3\n"
      "methods = \"radau_iia_2\"\ntolerances = [1e-3]\nthreads = [1, 2]\n",
      "small.toml", StudyVariant::kFull);
  made = runStudy(study, options, told);
  const Table after = timeOn(2, [](const auto&, double) { return static_cast<double>(getpid()); });
  ASSERT_EQ(after.rows.size(), 2u);
  for (const auto& row : after.rows) {
    const bool here = numberAt(after, row, "cpu_s") == static_cast<double>(getpid());
    EXPECT_EQ(here, textAt(after, row, "threads") == "2");
  }
}

TEST_F(TimedAtOnce, TheNumberOfCoresStandsBesideTheTimes) {
  timeOn(2);
  const auto runs = folder.path() / "small/runs.csv";
  EXPECT_EQ(timingCores(runs), "2 on " + hostName());
  const Table trials = readTable(folder.path() / "small/timing_cores.csv");
  ASSERT_EQ(trials.rows.size(), 1u);
  EXPECT_EQ(textAt(trials, trials.rows[0], "cores_at_once"), "2");
  EXPECT_EQ(textAt(trials, trials.rows[0], "taken"), "1");
  study.timing.repetitions = 4;
  timeOn(1);
  EXPECT_EQ(timingCores(runs), "1 or 2 in different passes on " + hostName());
  timeOn(1);
  EXPECT_EQ(readTable(folder.path() / "small/timing_cores.csv").rows.size(), 2u) << "nothing was left to time";
}

TEST_F(TimedAtOnce, CalibrationFindsTheNumber) {
  timeOn(0);
  const Table trials = readTable(folder.path() / "small/timing_cores.csv");
  ASSERT_GE(trials.rows.size(), 2u);
  EXPECT_EQ(textAt(trials, trials.rows[0], "cores_at_once"), "1");
  EXPECT_EQ(textAt(trials, trials.rows[1], "cores_at_once"), "2");
  double taken = 0;
  for (const auto& row : trials.rows) {
    EXPECT_GT(numberAt(trials, row, "elimination_slower"), 0.1);
    EXPECT_GT(numberAt(trials, row, "vectors_slower"), 0.1);
    taken += numberAt(trials, row, "taken");
  }
  EXPECT_EQ(taken, 1);
}

TEST_F(TimedAtOnce, ARunWhoseProcessDiesSaysWhy) {
  for (const int cores : {1, 2}) {
    const SharedCount calls;
    const Table after = timeOn(cores, [&](const auto& call, double min_time_s) {
      if (min_time_s < study.timing.min_time_s) return 1e-5;
      call();
      if (calls.add() == 2) cores == 1 ? throw std::runtime_error("out of luck") : raise(SIGKILL);
      return 2e-5;
    });
    std::size_t failed = 0;
    for (const auto& row : after.rows) {
      EXPECT_TRUE(succeededAt(after, row)) << "the integration has not failed";
      EXPECT_GT(numberAt(after, row, "error"), 0);
      const auto& detail = textAt(after, row, "detail");
      if (detail.empty()) {
        EXPECT_EQ(numberAt(after, row, "cpu_runs"), study.timing.repetitions);
        continue;
      }
      ++failed;
      const char* const cause = cores == 1 ? "not timed: out of luck" : "not timed: its process was ended by signal 9";
      EXPECT_NE(detail.find(cause), detail.npos) << detail;
      EXPECT_LT(numberAt(after, row, "cpu_runs"), study.timing.repetitions);
    }
    EXPECT_EQ(failed, 1u);
    EXPECT_NE(told.str().find("1 run could not be timed"), std::string::npos) << told.str();
    // The next pass tries again.
    const Table again = timeOn(cores);
    EXPECT_EQ(columnOf(again, "cpu_runs"), std::vector<std::string>(6, std::to_string(study.timing.repetitions)));
    EXPECT_EQ(columnOf(again, "detail"), std::vector<std::string>(6, ""));
    EXPECT_EQ(told.str().find("could not"), std::string::npos);
    study.timing.repetitions += 3;
  }
}

TEST_F(TimedAtOnce, AnInterruptLosesNoFinishedTime) {
  const pid_t here = getpid();
  const SharedCount calls;
  std::size_t kept = 0;
  {
    const InterruptScope interrupts;
    const Table after = timeOn(2, [&](const auto&, double min_time_s) {
      if (min_time_s >= study.timing.min_time_s && calls.add() == 0) kill(here, SIGINT);
      usleep(50'000);
      return 2e-5;
    });
    EXPECT_TRUE(interruptFlag());
    for (const auto& row : after.rows) kept += numberAt(after, row, "cpu_runs") > 0 ? 1U : 0U;
  }
  EXPECT_GE(kept, 1u) << "what was under way is finished and kept";
  EXPECT_LT(kept, 6u) << "nothing new is begun";
  const InterruptScope uninterrupted;  // the flag is false again
  EXPECT_EQ(columnOf(timeOn(2), "cpu_runs"), std::vector<std::string>(6, "3"));
}

TEST(TimingCoresOption, IsCheckedBeforeTheFirstRun) {
  const TemporaryFolder folder;
  const auto file = (folder.path() / "small.toml").string(), results = (folder.path() / "results").string();
  std::ofstream(file) << kTwoBlocks;
  const auto too_many = program({"run", file, "--results", results, "--timing-cores", "1024"});
  EXPECT_EQ(too_many.status, 2);
  EXPECT_TRUE(containsAll(too_many.err, {"timing-cores = 1024", "from 1 to"})) << too_many.err;
  EXPECT_EQ(program({"run", file, "--results", results, "--timing-cores", "two"}).status, 2);
  EXPECT_FALSE(std::filesystem::exists(results));
  const auto one = program({"run", file, "--results", results, "--timing-cores", "1"});
  EXPECT_EQ(one.status, 0) << one.err;
  EXPECT_TRUE(containsAll(one.err, {"small timing: 1 of"})) << one.err;
}

}  // namespace
}  // namespace irk
