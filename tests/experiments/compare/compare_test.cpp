// The comparison of results: statistics, the model of noise on synthetic tables, and the verb.
#include "experiments/compare/compare.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "experiments/commands/cli.h"
#include "experiments/compare/folders.h"
#include "experiments/compare/ratio.h"
#include "experiments/runs/run_table.h"
#include "tests/experiments/support.h"

namespace irk::compare {
namespace {

// --- Statistics.

// Two and two numbers have six orderings, with U = 0, 1, 2, 2, 3, 4.
TEST(Ratio, ProbabilitiesOfRanksAreThoseOfAllOrders) {
  const auto two = rankProbabilities(2, 2);
  const double expected[] = {1 / 6.0, 2 / 6.0, 4 / 6.0, 5 / 6.0, 1};
  ASSERT_EQ(two.size(), 5u);
  for (std::size_t u = 0; u < 5; ++u) EXPECT_NEAR(two[u], expected[u], 1e-15) << u;
  EXPECT_NEAR(rankProbabilities(5, 5)[0], 1 / 252.0, 1e-15);
  EXPECT_NEAR(rankProbabilities(5, 5)[2], 4 / 252.0, 1e-15);  // 1, 1 and 2 orders
}

// The normal approximation continues the exact values without a jump: at both sides of the limit, at the same
// distance from the mean.
TEST(Ratio, ManyNumbersHaveNearlyTheNormalDistribution) {
  const auto exact = rankProbabilities(20, 20), normal = rankProbabilities(20, 21);
  EXPECT_NEAR(exact[200 - 74], normal[210 - 76], 3e-3);
  EXPECT_NEAR(normal[210], 0.5, 6e-3);
}

TEST(Ratio, IsTheMedianWithAllOfTheRangeForFewNumbers) {
  const Ratio one = ratioOf({2}, {6}, 0.05);
  EXPECT_EQ(one.ratio, 3);
  EXPECT_EQ(one.low, 3);
  EXPECT_EQ(one.high, 3);
  EXPECT_EQ(one.level, 0);
  const Ratio two = ratioOf({1, 2}, {3, 8}, 0.05);  // 1.5, 3, 4, 8
  EXPECT_NEAR(two.ratio, std::sqrt(12), 1e-15);
  EXPECT_EQ(two.low, 1.5);
  EXPECT_EQ(two.high, 8);
  EXPECT_NEAR(two.level, 1 - 2 / 6.0, 1e-15);
}

// For samples of five and five P(U <= 2) = 4/252 and P(U <= 3) = 7/252: at 5 % two ratios are left out at each end,
// but not three.
TEST(Ratio, TheIntervalLeavesOutWhatTheTestDoes) {
  const std::vector<double> a{1, 1, 1, 1, 1}, b{1, 2, 3, 4, 5};  // each ratio five times
  const Ratio wide = ratioOf(a, b, 0.05);
  EXPECT_NEAR(wide.level, 1 - 8 / 252.0, 1e-12);
  EXPECT_EQ(wide.ratio, 3);
  EXPECT_NEAR(ratioOf(a, b, 0.06).level, 1 - 14 / 252.0, 1e-12);
  EXPECT_NEAR(ratioOf(a, b, 1e-9).level, 1 - 2 / 252.0, 1e-12) << "all of the range";
}

// Samples of one distribution: at most a fraction alpha of the intervals excludes 1, and not many fewer.
TEST(Ratio, TheIntervalHasItsLevel) {
  std::mt19937 random(1);
  std::lognormal_distribution<double> times(0, 0.1);
  constexpr int kTrials = 4000;
  int outside = 0;
  for (int i = 0; i < kTrials; ++i) {
    std::vector<double> a(8), b(8);
    for (auto* sample : {&a, &b}) std::generate(sample->begin(), sample->end(), [&] { return times(random); });
    const Ratio ratio = ratioOf(a, b, 0.05);
    if (ratio.low > 1 || ratio.high < 1) ++outside;
  }
  // P = 0.0499 for eight and eight: 200 of 4000, standard deviation 14.
  EXPECT_LT(outside, 200 + 4 * 14);
  EXPECT_GT(outside, 200 - 4 * 14);
}

// --- Tables.

constexpr const char* kColumns[] = {"key",   "scene",     "method",         "h",     "rtol",     "scalar", "outcome",
                                    "error", "residuals", "steps_accepted", "cpu_s", "cpu_runs", "cpu_all"};

std::string repetitions(double seconds, int count) {
  std::string all;
  for (int i = 0; i < count; ++i) all += fmt::format("{}{}", i ? " " : "", seconds * (1 + 0.01 * i));
  return all;
}

// Six successful runs of two methods, each with `count` repetitions one percent apart.
Runs someRuns(int count = 5) {
  Runs runs;
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

void set(Runs& runs, std::size_t row, const char* column, const std::string& cell) {
  runs.table.rows[row][runs.table.column(column)] = cell;
}
void setTime(Runs& runs, std::size_t row, double seconds, int count = 5) {
  set(runs, row, "cpu_s", fmt::format("{}", seconds));
  set(runs, row, "cpu_all", repetitions(seconds, count));
}

std::vector<Kind> kindsOf(const Comparison& comparison) {
  std::vector<Kind> kinds;
  for (const auto& difference : comparison.differences) kinds.push_back(difference.kind);
  return kinds;
}

TEST(Compare, NothingChangedIsNoDifference) {
  const Comparison same = compareRuns(someRuns(), someRuns(), {});
  EXPECT_TRUE(same.differences.empty());
  EXPECT_EQ(same.both, 6u);
  EXPECT_EQ(same.times.compared, 6u);
  EXPECT_EQ(same.times.few, 0u);
  EXPECT_DOUBLE_EQ(same.times.median, 1);
}

TEST(Compare, RunsAreMatchedByWhatWasAskedForNotByKeysAndDigits) {
  Runs other = someRuns();
  for (auto& row : other.table.rows) row[0] = "another version's key " + row[0];
  set(other, 0, "rtol", "0.001");
  std::reverse(other.table.rows.begin(), other.table.rows.end());
  EXPECT_TRUE(compareRuns(someRuns(), other, {}).differences.empty());
}

TEST(Compare, AMissingRunIsADifference) {
  Runs fewer = someRuns();
  fewer.table.rows.pop_back();
  for (const auto& comparison : {compareRuns(someRuns(), fewer, {}), compareRuns(fewer, someRuns(), {})}) {
    EXPECT_EQ(kindsOf(comparison), std::vector{Kind::kMissing});
    EXPECT_EQ(comparison.differences[0].run, "kepler gauss_2 rtol=1e-07");
  }
}

TEST(Compare, OutcomesComeFirstThenCountersErrorsAndTimes) {
  Runs other = someRuns();
  setTime(other, 0, 0.03);
  set(other, 1, "error", "1.25e-04");
  set(other, 2, "residuals", "1001");
  set(other, 3, "outcome", "newton_failed");
  set(other, 3, "residuals", "7");
  set(other, 3, "error", "nan");
  const Comparison comparison = compareRuns(someRuns(), other, {});
  EXPECT_EQ(kindsOf(comparison), (std::vector{Kind::kOutcome, Kind::kCounter, Kind::kError, Kind::kTime}))
      << "of a run with another outcome nothing else";
  EXPECT_EQ(comparison.differences[0].what, "success -> newton_failed");
  EXPECT_EQ(comparison.differences[1].what, "residuals 1000 -> 1001");
  EXPECT_EQ(comparison.differences[2].what, "error 1.25e-06 -> 0.000125");
  EXPECT_TRUE(containsAll(comparison.differences[3].what, {"time x 3"}));
}

TEST(Compare, CountersAreExactUnlessALimitIsGiven) {
  Runs other = someRuns();
  set(other, 0, "residuals", "1015");
  EXPECT_EQ(kindsOf(compareRuns(someRuns(), other, {})), std::vector{Kind::kCounter});
  EXPECT_TRUE(compareRuns(someRuns(), other, {.counters = 0.02}).differences.empty());
  set(other, 1, "residuals", "1030");
  EXPECT_EQ(kindsOf(compareRuns(someRuns(), other, {.counters = 0.02})), std::vector{Kind::kCounter});
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
    Runs first = someRuns(), second = someRuns();
    for (auto* runs : {&first, &second}) set(*runs, 0, "scalar", change.scalar);
    set(first, 0, "error", change.before);
    set(second, 0, "error", change.after);
    EXPECT_EQ(compareRuns(first, second, {}).differences.size(), change.differs ? 1u : 0u)
        << change.before << " -> " << change.after;
    EXPECT_TRUE(compareRuns(first, second, {.errors = 1e15}).differences.empty() ||
                std::isnan(std::stod(change.after)));
  }
}

// Three of six runs are three times slower: these three are reported, the largest change first.
TEST(Compare, ThreeRunsThreeTimesSlowerAreADifference) {
  for (const int count : {1, 3, 5, 9}) {
    Runs other = someRuns(count);
    setTime(other, 0, 0.03, count);
    setTime(other, 2, 0.032, count);
    setTime(other, 4, 0.031, count);
    const Comparison comparison = compareRuns(someRuns(count), other, {});
    ASSERT_EQ(kindsOf(comparison), std::vector(3, Kind::kTime)) << count;
    EXPECT_EQ(comparison.differences[0].run, "kepler radau_iia_3 rtol=1e-07");
    EXPECT_EQ(comparison.times.few, count < 5 ? 6u : 0u);
  }
}

// A change of twelve percent is reported if the repetitions separate it from noise, unless it is allowed.
TEST(Compare, SmallChangesOfTimesNeedRepetitions) {
  Runs other = someRuns();
  for (std::size_t row = 0; row < 6; ++row) setTime(other, row, 0.0112);
  EXPECT_EQ(compareRuns(someRuns(), other, {}).differences.size(), 6u);
  EXPECT_EQ(compareRuns(other, someRuns(), {}).differences.size(), 6u) << "faster is different, too";
  EXPECT_TRUE(compareRuns(someRuns(), other, {.times = 0.2}).differences.empty());
  Runs few = someRuns(4), few_slower = someRuns(4);
  for (std::size_t row = 0; row < 6; ++row) setTime(few_slower, row, 0.0112, 4);
  EXPECT_TRUE(compareRuns(few, few_slower, {}).differences.empty());
}

// 200 runs with times from one distribution with 20 % of noise: alpha is the level of all of them together.
TEST(Compare, NoiseIsNoDifference) {
  std::mt19937 random(7);
  std::lognormal_distribution<double> noise(0, 0.2);
  const auto noisy = [&] {
    Runs runs = someRuns(7);
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
  EXPECT_LE(compareRuns(noisy(), noisy(), {}).differences.size(), 1u);
}

TEST(Compare, AnotherProcessorIsNotComparable) {
  Runs other = someRuns();
  other.table.head = {{"cpu", "Processor Y"}};
  setTime(other, 0, 5);
  const Comparison comparison = compareRuns(someRuns(), other, {});
  EXPECT_TRUE(comparison.differences.empty());
  EXPECT_EQ(comparison.times.other_processor, 6u);
  EXPECT_TRUE(containsAll(textOf("kepler", comparison), {"not comparable", "Processor X", "Processor Y"}));
}

TEST(Compare, TheProcessorOfARowIsThatOfItsEnvironment) {
  const auto with = [](const char* processor) {
    Runs runs = someRuns();
    runs.table.columns.push_back("cpu_environment");
    for (auto& row : runs.table.rows) row.push_back("a-b");
    runs.processors = {{"a-b", processor}};
    return runs;
  };
  EXPECT_EQ(compareRuns(with("X"), with("X"), {}).times.compared, 6u);
  EXPECT_EQ(compareRuns(with("X"), with("Y"), {}).times.other_processor, 6u);
}

TEST(Compare, ColumnsOfOneTableOnlyAreSaid) {
  Runs other = someRuns();
  other.table.columns[other.table.column("residuals")] = "something_else";
  const Comparison comparison = compareRuns(someRuns(), other, {});
  EXPECT_TRUE(comparison.differences.empty());
  EXPECT_EQ(comparison.not_compared, std::vector<std::string>{"residuals (only in the first)"});
  other.table.columns[other.table.column("outcome")] = "end";
  EXPECT_TRUE(containsAll(misuseOf([&] { (void)compareRuns(someRuns(), other, {}); }), {"outcome"}));
}

TEST(Compare, TheTextShowsTheWorstTen) {
  Comparison comparison;
  for (int i = 0; i < 12; ++i) {
    comparison.differences.push_back({Kind::kError, fmt::format("run {}", i), "error", 12.0 - i});
  }
  comparison.times.few = 3;
  const auto text = textOf("order", comparison);
  EXPECT_TRUE(containsAll(text, {"12 different, the worst 10", "run 9:", "fewer than five"}));
  EXPECT_EQ(text.find("run 10:"), text.npos);
}

// --- The verb.

struct Ended {
  int status;
  std::string out, err;
};
Ended compareFolders(const std::vector<std::string>& arguments) {
  std::vector<std::string> all{"compare"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  std::ostringstream out, err;
  const int status = runProgram(all, {out, err});
  return {status, out.str(), err.str()};
}

TEST(CompareVerb, StudiesAndTreesByStatus) {
  const TemporaryFolder folder;
  const auto at = [&](const char* name) { return (folder.path() / name).string(); };
  Runs changed = someRuns();
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
  for (const auto& bad : std::vector<std::vector<std::string>>{{at("one"), at("nowhere")},
                                                               {at("one"), at("one/order/runs.csv")},
                                                               {at("one"), at("same"), "--times", "5"},
                                                               {at("one"), at("same"), "--errors", "0.5"},
                                                               {at("one"), at("same"), "--alpha", "1"},
                                                               {at("one"), at("same"), "--counters", "-1%"},
                                                               {at("one")}}) {
    EXPECT_EQ(compareFolders(bad).status, 2) << bad.back();
  }
}

}  // namespace
}  // namespace irk::compare
