// The comparison of results: the model of noise on synthetic tables, and the verb.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "experiments/compare/folders.h"
#include "experiments/runs/run_table.h"
#include "tests/experiments/compared_tables.h"
#include "tests/experiments/program.h"

namespace irk::compare {
namespace {

// --- Small tables.

constexpr const char* kColumns[] = {"key",   "scene",     "method",         "h",     "rtol",     "scalar", "outcome",
                                    "error", "residuals", "steps_accepted", "cpu_s", "cpu_runs", "cpu_all"};

/// A table of runs that is not written yet.
struct Made {
  Table table;
  std::map<std::string, std::string> processors = {};
};

Comparison compared(const Made& first, const Made& second, const Limits& limits) {
  return irk::compared(first.table, second.table, limits, first.processors, second.processors);
}

std::string repetitions(double seconds, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += fmt::format("{}{}", i ? " " : "", seconds * (1 + 0.01 * i));
  return all;
}

// Six successful runs of two methods, each with `count` repetitions one percent apart.
Made someRuns(int count = 5) {
  Made runs;
  runs.table.head = {{"cpu", "Processor X"}};
  runs.table.columns.assign(std::begin(kColumns), std::end(kColumns));
  for (const char* method : {"radau_iia_3", "gauss_2"}) {
    for (const char* rtol : {"1e-3", "1e-5", "1e-7"}) {
      runs.table.rows.push_back({fmt::format("{}{}", method, rtol), "kepler", method, "0", rtol, "double", "success",
                                 "1.25e-06", "1000", "50", "0.01", std::to_string(count), repetitions(0.01, count)});
    }
  }
  return runs;
}

void set(Made& runs, std::size_t row, const char* column, const std::string& cell) {
  runs.table.rows[row][runs.table.column(column)] = cell;
}
void setTime(Made& runs, std::size_t row, double seconds, int count = 5) {
  set(runs, row, "cpu_s", fmt::format("{}", seconds));
  set(runs, row, "cpu_all", repetitions(seconds, count));
}

std::vector<Kind> kindsOf(const Comparison& comparison) {
  std::vector<Kind> kinds;
  for (const auto& difference : comparison.differences) kinds.push_back(difference.kind);
  return kinds;
}

TEST(Compare, NothingChangedIsNoDifference) {
  const Comparison same = compared(someRuns(), someRuns(), {});
  EXPECT_TRUE(same.differences.empty());
  EXPECT_EQ(same.both, 6u);
  EXPECT_EQ(same.times.compared, 6u);
  EXPECT_EQ(same.times.few, 0u);
  EXPECT_DOUBLE_EQ(same.times.median, 1);
}

TEST(Compare, LeastMedianAndMostOfTheTimes) {
  Made other = someRuns();
  for (const std::size_t i : {4u, 2u, 5u, 3u}) setTime(other, i, 0.01 * static_cast<double>(7 - i));
  const Times times = compared(someRuns(), other, {}).times;
  EXPECT_NEAR(times.least, 1, 1e-12);
  EXPECT_NEAR(times.median, 2.5, 1e-12);
  EXPECT_NEAR(times.most, 5, 1e-12);
}

TEST(Compare, RunsAreMatchedBySettingsNotByKeysAndDigits) {
  Made other = someRuns();
  for (auto& row : other.table.rows) row[0] = "another version's key " + row[0];
  set(other, 0, "rtol", "0.001");
  std::reverse(other.table.rows.begin(), other.table.rows.end());
  EXPECT_TRUE(compared(someRuns(), other, {}).differences.empty());
}

TEST(Compare, AMissingRunIsADifference) {
  Made fewer = someRuns();
  fewer.table.rows.pop_back();
  for (const auto& comparison : {compared(someRuns(), fewer, {}), compared(fewer, someRuns(), {})}) {
    EXPECT_EQ(kindsOf(comparison), std::vector{Kind::kMissing});
    EXPECT_EQ(comparison.differences[0].run, "kepler gauss_2 rtol=1e-07");
  }
}

TEST(Compare, OutcomesComeFirstThenCountersErrorsAndTimes) {
  Made other = someRuns();
  setTime(other, 0, 0.03);
  set(other, 1, "error", "1.25e-04");
  set(other, 2, "residuals", "1001");
  set(other, 3, "outcome", "newton_failed");
  set(other, 3, "residuals", "7");
  set(other, 3, "error", "nan");
  const Comparison comparison = compared(someRuns(), other, {});
  EXPECT_EQ(kindsOf(comparison), (std::vector{Kind::kOutcome, Kind::kCounter, Kind::kError, Kind::kTime}))
      << "of a run with another outcome nothing else";
  EXPECT_EQ(comparison.differences[0].what, "success -> newton_failed");
  EXPECT_EQ(comparison.differences[1].what, "residuals 1000 -> 1001");
  EXPECT_EQ(comparison.differences[2].what, "error 1.25e-06 -> 0.000125");
  EXPECT_TRUE(containsAll(comparison.differences[3].what, {"time x 3"}));
}

TEST(Compare, CountersAreExactUnlessALimitIsGiven) {
  Made other = someRuns();
  set(other, 0, "residuals", "1015");
  EXPECT_EQ(kindsOf(compared(someRuns(), other, {})), std::vector{Kind::kCounter});
  EXPECT_TRUE(compared(someRuns(), other, {.counters = 0.02}).differences.empty());
  set(other, 1, "residuals", "1030");
  EXPECT_EQ(kindsOf(compared(someRuns(), other, {.counters = 0.02})), std::vector{Kind::kCounter});
}

struct ErrorChange {
  const char* before;
  const char* after;
  const char* scalar;
  bool differs;
};

TEST(Compare, ErrorsDifferByAFactorAboveRoundOff) {
  const ErrorChange changes[] = {
      {"1e-6", "1.9e-6", "double", false},
      {"1e-6", "2.1e-6", "double", true},
      {"2.1e-6", "1e-6", "double", true},
      {"1e-16", "1e-14", "double", false},
      {"0", "1e-14", "double", false},
      {"1e-14", "3e-14", "double", true},
      {"1e-30", "1e-29", "mp50", true},
      {"1e-51", "1e-49", "mp50", false},
      {"nan", "nan", "double", false},
      {"1e-6", "nan", "double", true},
      {"1.25e-6", "1.25000000000001e-6", "double", false},
  };
  for (const auto& change : changes) {
    Made first = someRuns(), second = someRuns();
    for (auto* runs : {&first, &second}) set(*runs, 0, "scalar", change.scalar);
    set(first, 0, "error", change.before);
    set(second, 0, "error", change.after);
    EXPECT_EQ(compared(first, second, {}).differences.size(), change.differs ? 1u : 0u)
        << change.before << " -> " << change.after;
    EXPECT_TRUE(compared(first, second, {.errors = 1e15}).differences.empty() || std::isnan(std::stod(change.after)));
  }
}

// Three of six runs are three times slower: these three are reported, the largest change first.
TEST(Compare, ThreeRunsThreeTimesSlowerAreADifference) {
  for (const int count : {1, 3, 5, 9}) {
    Made other = someRuns(count);
    setTime(other, 0, 0.03, count);
    setTime(other, 2, 0.032, count);
    setTime(other, 4, 0.031, count);
    const Comparison comparison = compared(someRuns(count), other, {});
    ASSERT_EQ(kindsOf(comparison), std::vector(3, Kind::kTime)) << count;
    EXPECT_EQ(comparison.differences[0].run, "kepler radau_iia_3 rtol=1e-07");
    EXPECT_EQ(comparison.times.few, count < 5 ? 6u : 0u);
  }
}

// A change of twelve percent is reported if the repetitions separate it from noise, unless it is allowed.
TEST(Compare, SmallChangesOfTimesNeedRepetitions) {
  Made other = someRuns();
  for (std::size_t row = 0; row < 6; ++row) setTime(other, row, 0.0112);
  EXPECT_EQ(compared(someRuns(), other, {}).differences.size(), 6u);
  EXPECT_EQ(compared(other, someRuns(), {}).differences.size(), 6u) << "faster is different, too";
  EXPECT_TRUE(compared(someRuns(), other, {.times = 0.2}).differences.empty());
  Made few = someRuns(4), few_slower = someRuns(4);
  for (std::size_t row = 0; row < 6; ++row) setTime(few_slower, row, 0.0112, 4);
  EXPECT_TRUE(compared(few, few_slower, {}).differences.empty());
}

// 200 runs with times from one distribution with 20 % of noise: alpha is the level of all of them together.
TEST(Compare, NoiseIsNoDifference) {
  std::mt19937 random(7);
  std::lognormal_distribution<double> noise(0, 0.2);
  const auto noisy = [&] {
    Made runs = someRuns(7);
    const TableRow row = runs.table.rows.front();
    runs.table.rows.clear();
    for (int i = 0; i < 200; ++i) {
      runs.table.rows.push_back(row);
      std::string all;
      for (int k = 0; k < 7; ++k) all += fmt::format("{} ", 0.01 * noise(random));
      set(runs, static_cast<std::size_t>(i), "h", fmt::format("{}", i));
      set(runs, static_cast<std::size_t>(i), "cpu_all", all);
    }
    return runs;
  };
  // For samples of seven and seven one ordering in 1716 separates them completely: among 200 runs that happens with
  // probability 12 %, if it is a difference of more than 5 %.
  EXPECT_LE(compared(noisy(), noisy(), {}).differences.size(), 1u);
}

TEST(Compare, AnotherProcessorIsNotComparable) {
  Made other = someRuns();
  other.table.head = {{"cpu", "Processor Y"}};
  setTime(other, 0, 5);
  const Comparison comparison = compared(someRuns(), other, {});
  EXPECT_TRUE(comparison.differences.empty());
  EXPECT_EQ(comparison.times.other_processor, 6u);
  EXPECT_TRUE(containsAll(textOf("kepler", comparison), {"not comparable", "Processor X", "Processor Y"}));
}

TEST(Compare, TheProcessorOfARowIsThatOfItsEnvironment) {
  const auto with = [](const char* processor) {
    Made runs = someRuns();
    runs.table.columns.push_back("cpu_environment");
    for (auto& row : runs.table.rows) row.push_back("a-b");
    runs.processors = {{"a-b", processor}};
    return runs;
  };
  EXPECT_EQ(compared(with("X"), with("X"), {}).times.compared, 6u);
  EXPECT_EQ(compared(with("X"), with("Y"), {}).times.other_processor, 6u);
}

TEST(Compare, ColumnsOfOneTableOnlyAreReported) {
  Made other = someRuns();
  other.table.columns[other.table.column("residuals")] = "something_else";
  const Comparison comparison = compared(someRuns(), other, {});
  EXPECT_TRUE(comparison.differences.empty());
  EXPECT_EQ(comparison.not_compared, std::vector<std::string>{"residuals (only in the first)"});
  other.table.columns[other.table.column("outcome")] = "end";
  EXPECT_TRUE(containsAll(misuseOf([&] { (void)compared(someRuns(), other, {}); }), {"outcome"}));
}

// Of twelve errors the ten largest, the largest first; the two with equal sizes in the order of the table.
TEST(Compare, TheTextShowsTheWorstTen) {
  Made first, second;
  const Made some = someRuns(3);
  for (auto* made : {&first, &second}) made->table = {some.table.head, some.table.columns, {}};
  for (int i = 0; i < 12; ++i) {
    for (auto* made : {&first, &second}) {
      made->table.rows.push_back(some.table.rows[0]);
      set(*made, static_cast<std::size_t>(i), "h", std::to_string(i));
    }
    set(second, static_cast<std::size_t>(i), "error", fmt::format("{}", i == 4 ? 10.0 : 15.0 - i));
  }
  const Comparison comparison = compared(first, second, {});
  EXPECT_EQ(comparison.total(), 12u);
  ASSERT_EQ(comparison.differences.size(), 10u);
  EXPECT_EQ(comparison.differences[0].run, "kepler radau_iia_3 h=0");
  EXPECT_EQ(comparison.differences[4].run, "kepler radau_iia_3 h=4");
  EXPECT_EQ(comparison.differences[5].run, "kepler radau_iia_3 h=5");
  const auto text = textOf("order", comparison);
  EXPECT_TRUE(containsAll(text, {"12 differences", "12 different, the worst 10", "h=9:", "fewer than five"}));
  EXPECT_EQ(text.find("h=10:"), text.npos);
}

// The least ratio of 25 is below 1, the next one is 1.09. At a level of 5 % two are left out at each end; at that of
// one of seven runs none is. Whether the run is the first or the last one to be read makes no difference.
TEST(Compare, TheLevelIsThatOfAllRuns) {
  for (const std::size_t runs : {1u, 7u}) {
    for (const std::size_t changed : {std::size_t{0}, runs - 1}) {
      Made first = someRuns();
      first.table.rows.resize(runs, first.table.rows.front());
      for (std::size_t i = 0; i < runs; ++i) set(first, i, "h", std::to_string(i));
      Made second = first;
      set(first, changed, "cpu_all", "0.0110 0.01 0.01 0.01 0.01");
      set(second, changed, "cpu_all", "0.0109 0.02 0.02 0.02 0.02");
      EXPECT_EQ(compared(first, second, {}).total(), runs == 1 ? 1u : 0u) << runs << changed;
      set(second, changed, "cpu_all", "0.02 0.02 0.02 0.02 0.02");
      EXPECT_EQ(compared(first, second, {}).total(), 1u) << runs << changed;
    }
  }
}

// --- The verb.

Ended compareFolders(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "compare");
  return program(arguments);
}

TEST(CompareVerb, StudiesAndTreesByStatus) {
  const TemporaryFolder folder;
  const auto at = [&](const char* name) { return (folder.path() / name).string(); };
  Made changed = someRuns();
  setTime(changed, 0, 0.05);
  for (const char* study : {"one/order", "one/steps", "same/order", "same/steps", "slower/order", "less/order"}) {
    writeTable(folder.path() / study / "runs.csv", someRuns().table);
  }
  writeTable(folder.path() / "slower/steps/runs.csv", changed.table);
  EXPECT_EQ(compareFolders({at("one"), at("same")}).status, 0);
  EXPECT_EQ(compareFolders({at("one/order"), at("same/steps")}).status, 0) << "two folders of a study each";
  const Ended slower = compareFolders({at("one"), at("slower")});
  EXPECT_EQ(slower.status, 1);
  EXPECT_TRUE(containsAll(slower.out, {"order: 6 runs and 6 runs: 0 differences", "steps: 6 runs", "times: 1 different",
                                       "radau_iia_3", "time x 5"}));
  EXPECT_EQ(compareFolders({at("one"), at("slower"), "--times", "500%"}).status, 0);
  const Ended less = compareFolders({at("one"), at("less")});
  EXPECT_EQ(less.status, 1);
  EXPECT_TRUE(containsAll(less.out, {"steps: only in the first"}));
  expectOneLine({{2, {"compare", at("one"), at("nowhere")}, "nowhere"},
                 {2, {"compare", at("one"), at("one/order/runs.csv")}, "runs.csv"},
                 {2, {"compare", at("one"), at("same"), "--times", "5"}, "times"},
                 {2, {"compare", at("one"), at("same"), "--errors", "0.5"}, "errors"},
                 {2, {"compare", at("one"), at("same"), "--alpha", "1"}, "alpha"},
                 {2, {"compare", at("one"), at("same"), "--counters", "-1%"}, "counters"},
                 {2, {"compare", at("one")}, "second"}});
}

}  // namespace
}  // namespace irk::compare
