// Times are CPU seconds per integration; their statistics are correct.
#include "experiments/runner/timing.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>

#include "experiments/base/clock.h"
#include "experiments/runner/status.h"
#include "experiments/study/study_reader.h"
#include "tests/experiments/study_runs.h"

namespace irk {
namespace {

/// A call that uses CPU time or sleeps, and records what it did.
struct MadeUpCall {
  double busy_s, asleep_s;
  int calls = 0;
  double spent = 0;

  void operator()() {
    const double start = threadSeconds();
    while (threadSeconds() - start < busy_s) {
    }
    if (asleep_s > 0) std::this_thread::sleep_for(std::chrono::duration<double>(asleep_s));
    spent += threadSeconds() - start;
    ++calls;
  }
};

TEST(TimeCall, IsOfOneCall) {
  MadeUpCall call{2e-4, 0};
  const double seconds = timeCall(std::ref(call), 0.02);
  ASSERT_GT(call.calls, 20);
  EXPECT_NEAR(seconds, call.spent / call.calls, 0.5 * call.spent / call.calls);
}

TEST(TimeCall, LeavesNothingBehindAfterAnException) {
  int throws = 0, calls = 0;
  const std::function<void()> first = [&] {
    if (++throws == 1) throw std::runtime_error("no");
  };
  EXPECT_THROW(timeCall(first, 1e-4), std::runtime_error);
  timeCall([&] { ++calls; }, 1e-4);
  EXPECT_EQ(throws, 1);
  EXPECT_GT(calls, 0);
}

TEST(TimeCall, CountsNoTimeAsleep) {
  MadeUpCall call{1e-4, 2e-3};
  const double seconds = timeCall(std::ref(call), 0.001);
  ASSERT_GT(call.calls, 0);
  EXPECT_GE(seconds, 1e-4);
  EXPECT_LT(seconds, 1e-3) << "2.1e-3 of the clock on the wall";
}

TEST(TimeCall, LastsAsLongAsAskedFor) {
  MadeUpCall brief{1e-5, 0}, lasting{1e-5, 0};
  (void)timeCall(std::ref(brief), 0.002);
  (void)timeCall(std::ref(lasting), 0.02);
  EXPECT_GT(lasting.spent, 0.01);
  EXPECT_GT(lasting.spent, 2 * brief.spent);
}

TEST(TimingOf, MinimumMedianSpreadAndNumber) {
  const Timing odd = timingOf({5, 2, 9, 3, 4});
  EXPECT_EQ(odd.minimum_s, 2);
  EXPECT_EQ(odd.median_s, 4);
  EXPECT_EQ(odd.spread, 3.5);
  EXPECT_EQ(odd.all_s, (std::vector<double>{5, 2, 9, 3, 4}));
  const Timing even = timingOf({8, 1, 2, 4});
  EXPECT_EQ(even.minimum_s, 1);
  EXPECT_EQ(even.median_s, 4);
  EXPECT_EQ(even.spread, 7);
  EXPECT_EQ(even.all_s.size(), 4u);
  const Timing one = timingOf({0.5});
  EXPECT_EQ(one.minimum_s, 0.5);
  EXPECT_EQ(one.median_s, 0.5);
  EXPECT_EQ(one.spread, 0);
}

constexpr char kTimedStudy[] = R"(
[[block]]
scene = "pendulum"
t_end = 0.5
methods = "radau_iia_3"
tolerances = [1e-4, 1e-7]
)";

// Times the study and reads what is exported.
Table timed(const Study& study, store::Store& store, const TimeCall& time_call = timeCall) {
  std::ostringstream quiet;
  const RunKeys keys = runKeys(study, {});
  timeStudy(study, keys, store, {}, quiet, time_call);
  store.exportTables(keys, quiet);
  return readTable(store.folder() / "runs.csv");
}

TEST(TimeStudy, KeepsMinimumMedianAndSpreadApart) {
  const TemporaryFolder folder;
  std::ostringstream quiet;
  Study study = parseStudy(kTimedStudy, "small.toml", StudyVariant::kFull);
  RunnerOptions options;
  options.results = folder.path();
  options.jobs = 1;
  runStudy(study, options, quiet);
  study.timing = {true, 1e-3, 5, 10, 20};
  store::Store store(folder.path() / "small", study.id, store::Use::kWrite, {}, quiet);
  const Table read = timed(study, store);
  ASSERT_EQ(read.rows.size(), 2u);
  for (const auto& row : read.rows) {
    const double least = numberAt(read, row, "cpu_s"), median = numberAt(read, row, "cpu_median_s");
    EXPECT_LT(least, median) << "five measured times are not equal";
    EXPECT_LE(median, least * (1 + numberAt(read, row, "cpu_spread")) * (1 + 1e-12));
    EXPECT_EQ(numberAt(read, row, "cpu_runs"), 5);
    const double setup = numberAt(read, row, "cpu_setup_s");
    EXPECT_GT(setup, 0);
    EXPECT_LT(setup, median) << "a part of the whole call";
    EXPECT_LT(least, 0.1) << "of one integration";
  }
}

// Hosts that time at the same time share the series.
TEST(TimeStudy, HostsShareTheSeries) {
  const TemporaryFolder folder;
  std::ostringstream quiet;
  Study study = parseStudy(
      "[[block]]\nscene = \"kepler\"\nt_end = 0.1\nmethods = [\"gauss_1\", \"gauss_2\", \"gauss_3\"]\n"
      "tolerances = [1e-3, 1e-4]\n",
      "small.toml", StudyVariant::kFull);
  RunnerOptions options;
  options.results = folder.path();
  options.jobs = 1;
  runStudy(study, options, quiet);
  study.timing = {true, 1e-5, 2, 10, 20};
  const RunKeys keys = runKeys(study, {});
  const auto repetitions = [&](const store::Store& store) {
    std::vector<int> all;
    keys.forEach([&](std::uint64_t key, const std::string&) { all.push_back(store.runs().find(key)->repetitions); });
    return all;
  };
  store::Store store(folder.path() / "small", study.id, store::Use::kWrite, {}, quiet);
  timeStudy(study, keys, store, {.host = 1, .hosts = 2}, quiet);
  EXPECT_EQ(repetitions(store), (std::vector<int>{0, 0, 2, 2, 0, 0}));
  timeStudy(study, keys, store, {.host = 0, .hosts = 2}, quiet);
  EXPECT_EQ(repetitions(store), (std::vector<int>{2, 2, 2, 2, 2, 2}));
}

// The times of a study's runs by their ends; 0: not timed.
std::map<double, double> timedEnds(const std::string& ends) {
  const TemporaryFolder folder;
  std::ostringstream quiet;
  Study study = parseStudy(
      "[[block]]\nscene = \"kepler\"\nmethods = \"radau_iia_3\"\ntolerances = [1e-4]\nt_end = [" + ends + "]\n",
      "small.toml", StudyVariant::kFull);
  RunnerOptions options;
  options.results = folder.path();
  options.jobs = 1;
  runStudy(study, options, quiet);
  study.timing = {true, 1e-5, 1, 10, 20};
  store::Store store(folder.path() / "small", study.id, store::Use::kWrite, {}, quiet);
  std::map<double, double> times;
  const Table runs = timed(study, store);
  for (const auto& row : runs.rows) times[numberAt(runs, row, "t_end")] = numberAt(runs, row, "cpu_runs");
  EXPECT_EQ(statusOf(study, options, store).to_time, 0u) << "status counts what is timed";
  return times;
}

// Ten ends give the error over time: only the last integration is timed, the one that goes farthest. Nine are runs of
// their own.
TEST(TimeStudy, TimesTheLastOfTenEnds) {
  const std::string nine = "0.01, 0.02, 0.03, 0.04, 0.05, 0.06, 0.07, 0.08, 0.1";
  const std::string back = "-0.01, -0.02, -0.03, -0.04, -0.05, -0.06, -0.07, -0.08, -0.1";
  for (const auto& [end, runs] : timedEnds(nine)) EXPECT_EQ(runs, 1) << end;
  for (const auto& [end, runs] : timedEnds(nine + ", 0.09")) EXPECT_EQ(runs, end == 0.1 ? 1 : 0) << end;
  for (const auto& [end, runs] : timedEnds(back + ", -0.09")) EXPECT_EQ(runs, end == -0.1 ? 1 : 0) << end;
  const auto both = timedEnds(back + ", " + nine);
  ASSERT_EQ(both.size(), 18u);
  for (const auto& [end, runs] : both) EXPECT_EQ(runs, end == -0.1 || end == 0.1 ? 1 : 0) << end;
}

// Long runs are repeated once; the longest keep the time of the accuracy run; failed runs have no time.
TEST(TimeStudy, TimesByTheLengthOfTheRun) {
  const TemporaryFolder folder;
  std::ostringstream quiet;
  Study study = parseStudy(kTimedStudy, "small.toml", StudyVariant::kFull);
  RunnerOptions options;
  options.results = folder.path();
  options.jobs = 1;
  const Table runs = runStudy(study, options, quiet);
  store::Store store(folder.path() / "small", study.id, store::Use::kWrite, {}, quiet);
  int request = 1;
  const auto repetitions = [&](const char* cpu, const char* outcome) {
    for (TableRow row : runs.rows) {
      row[runs.column("cpu_s")] = cpu;
      row[runs.column("outcome")] = outcome;
      row[runs.column("remade")] = std::to_string(request);  // replaces the rows before
      store.addTimes(row);
    }
    ++request;
    study.timing = {true, 1e-4, 3, 0.5, 3};
    const Table table = timed(study, store, [&](const auto&, double) { return std::stod(cpu); });
    return numberAt(table, table.rows.front(), "cpu_runs");
  };
  EXPECT_EQ(repetitions("3.5", "success"), 0);
  EXPECT_EQ(repetitions("0.4", "max_steps"), 0);
  EXPECT_EQ(repetitions("0.6", "success"), 1);
  EXPECT_EQ(repetitions("0.4", "success"), 3);
}

/// Stores the runs of a small study, the first one with a made-up accuracy time, and times it with a made-up clock.
class MadeUpTimes : public testing::Test {
 protected:
  MadeUpTimes() : study_(parseStudy(kTimedStudy, "small.toml", StudyVariant::kFull)) {
    RunnerOptions options;
    options.results = folder_.path();
    options.jobs = 1;
    made_ = runStudy(study_, options, quiet_);
    study_.timing = {true, 1e-3, 3, 0.5, 3};
  }

  // The cells cpu_all of the first run after a start of the program, which measures these times in turn.
  std::string allAfter(const std::vector<double>& seconds) {
    store::Store store(folder_.path() / "small", study_.id, store::Use::kWrite, {}, quiet_);
    const RunKeys keys = runKeys(study_, {});
    std::size_t next = 0;
    timeStudy(study_, keys, store, {.host = 0, .hosts = 1}, quiet_, [&](const auto&, double min_time_s) {
      if (min_time_s < study_.timing.min_time_s) return 1e-3;  // the set-up
      EXPECT_LT(next, seconds.size()) << "one time too many";
      return next < seconds.size() ? seconds[next++] : 1.0;
    });
    EXPECT_EQ(next, seconds.size());
    store.exportTables(keys, quiet_);
    const Table table = readTable(folder_.path() / "small/runs.csv");
    return textAt(table, table.rows.front(), "cpu_all");
  }

  // Stores new rows for both runs: the first with this time of its accuracy run, the second as failed.
  void setAccuracyTime(const char* seconds) {
    store::Store store(folder_.path() / "small", study_.id, store::Use::kWrite, {}, quiet_);
    for (TableRow row : made_.rows) {
      const bool first = row == made_.rows.front();
      row[made_.column("cpu_s")] = seconds;
      if (!first) row[made_.column("outcome")] = "max_steps";
      row[made_.column("remade")] = "1";  // replaces the rows before
      store.addTimes(row);
    }
  }

  TemporaryFolder folder_;
  std::ostringstream quiet_;
  Study study_;
  Table made_;
};

TEST_F(MadeUpTimes, OneSlowFirstMeasurementDoesNotEndTheRepetitions) {
  setAccuracyTime("0.4");
  EXPECT_EQ(allAfter({0.7, 0.41, 0.42}), "0.7 0.41 0.42");
  EXPECT_EQ(allAfter({}), "0.7 0.41 0.42");
}

TEST_F(MadeUpTimes, OneVerySlowFirstMeasurementDoesNotEither) {
  setAccuracyTime("0.4");
  EXPECT_EQ(allAfter({5, 0.41, 0.42}), "5 0.41 0.42");
}

TEST_F(MadeUpTimes, TwoSlowMeasurementsDo) {
  setAccuracyTime("0.4");
  EXPECT_EQ(allAfter({0.7, 0.6}), "0.7 0.6");
  EXPECT_EQ(allAfter({}), "0.7 0.6");
}

TEST_F(MadeUpTimes, ASlowAccuracyRunDoesNotEndTheRepetitions) {
  setAccuracyTime("0.6");
  EXPECT_EQ(allAfter({0.4, 0.42, 0.41}), "0.4 0.42 0.41") << "in the same start";
}

TEST_F(MadeUpTimes, LongRunsAreMeasuredOnce) {
  setAccuracyTime("0.6");
  EXPECT_EQ(allAfter({0.7}), "0.7");
  EXPECT_EQ(allAfter({}), "0.7");
}

// A start that was killed after its first measurement.
TEST_F(MadeUpTimes, AResumeMeasuresWhatIsMissing) {
  setAccuracyTime("0.4");
  study_.timing.repetitions = 1;
  EXPECT_EQ(allAfter({0.45}), "0.45");
  study_.timing.repetitions = 3;
  EXPECT_EQ(allAfter({0.46, 0.44}), "0.45 0.46 0.44");
}

}  // namespace
}  // namespace irk
