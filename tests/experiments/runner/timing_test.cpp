// Times are CPU seconds per integration; their statistics are correct.
#include "experiments/runner/timing.h"

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <thread>

#include "experiments/base/clock.h"
#include "experiments/runner/status.h"
#include "tests/experiments/runner/timed_study.h"

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

TEST(TimeStudy, KeepsMinimumMedianAndSpreadApart) {
  TimedStudy timed(kTimedStudy);
  timed.study.timing = {true, 1e-3, 5, 10, 20};
  const Table read = timed.time();
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
  TimedStudy timed(
      "[[block]]\nscene = \"kepler\"\nt_end = 0.1\nmethods = [\"gauss_1\", \"gauss_2\", \"gauss_3\"]\n"
      "tolerances = [1e-3, 1e-4]\n");
  timed.study.timing = {true, 1e-5, 2, 10, 20};
  const auto repetitions = [&] {
    std::vector<int> all;
    const store::Store store = timed.open();
    runKeys(timed.study, {}).forEach([&](std::uint64_t key, const std::string&) {
      all.push_back(store.runs().find(key)->repetitions);
    });
    return all;
  };
  timed.time({.host = 1, .hosts = 2});
  EXPECT_EQ(repetitions(), (std::vector<int>{0, 0, 2, 2, 0, 0}));
  timed.time({.host = 0, .hosts = 2});
  EXPECT_EQ(repetitions(), (std::vector<int>{2, 2, 2, 2, 2, 2}));
}

// The times of a study's runs by their ends; 0: not timed.
std::map<double, double> timedEnds(const std::string& ends) {
  TimedStudy timed("[[block]]\nscene = \"kepler\"\nmethods = \"radau_iia_3\"\ntolerances = [1e-4]\nt_end = [" + ends +
                   "]\n");
  timed.study.timing = {true, 1e-5, 1, 10, 20};
  std::map<double, double> times;
  const Table runs = timed.time();
  for (const auto& row : runs.rows) times[numberAt(runs, row, "t_end")] = numberAt(runs, row, "cpu_runs");
  EXPECT_EQ(statusOf(timed.study, timed.options, timed.open()).to_time, 0u) << "status counts what is timed";
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

/// The runs of a small study with a made-up clock.
class MadeUpTimes : public testing::Test, public TimedStudy {
 protected:
  MadeUpTimes() : TimedStudy(kTimedStudy) { study.timing = {true, 1e-3, 3, 0.5, 3}; }

  // Stores new rows for the runs: with this time of their accuracy runs, the first with the first outcome.
  void setAccuracy(const char* seconds, const char* outcome, const char* of_others) {
    store::Store store = open();
    ++request_;
    for (TableRow row : made.rows) {
      row[made.column("cpu_s")] = seconds;
      row[made.column("outcome")] = row.front() == made.rows.front().front() ? outcome : of_others;
      row[made.column("remade")] = std::to_string(request_);  // replaces the rows before
      store.addTimes(row);
    }
  }
  void setAccuracyTime(const char* seconds) { setAccuracy(seconds, "success", "max_steps"); }

  // The cells cpu_all of the first run after a start of the program, which measures these times in turn.
  std::string allAfter(const std::vector<double>& seconds) {
    std::size_t next = 0;
    const Table table = time({.host = 0, .hosts = 1}, [&](const auto&, double min_time_s) {
      if (min_time_s < study.timing.min_time_s) return 1e-3;  // the set-up
      EXPECT_LT(next, seconds.size()) << "one time too many";
      return next < seconds.size() ? seconds[next++] : 1.0;
    });
    EXPECT_EQ(next, seconds.size());
    return textAt(table, table.rows.front(), "cpu_all");
  }

 private:
  int request_ = 0;
};

// Long runs are repeated once; the longest keep the time of the accuracy run; failed runs have no time.
TEST_F(MadeUpTimes, AreThoseForTheLengthOfTheRun) {
  const auto repetitions = [&](const char* cpu, const char* outcome) {
    setAccuracy(cpu, outcome, outcome);
    const Table table = time({}, [&](const auto&, double) { return std::stod(cpu); });
    return numberAt(table, table.rows.front(), "cpu_runs");
  };
  EXPECT_EQ(repetitions("3.5", "success"), 0);
  EXPECT_EQ(repetitions("0.4", "max_steps"), 0);
  EXPECT_EQ(repetitions("0.6", "success"), 1);
  EXPECT_EQ(repetitions("0.4", "success"), 3);
}

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
  study.timing.repetitions = 1;
  EXPECT_EQ(allAfter({0.45}), "0.45");
  study.timing.repetitions = 3;
  EXPECT_EQ(allAfter({0.46, 0.44}), "0.45 0.46 0.44");
}

}  // namespace
}  // namespace irk
