// The judge of all claims against cases that are computed by hand.
#include "experiments/claims/verdict.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/claims/sensitivity.h"
#include "tests/experiments/support.h"

namespace irk::claims {
namespace {

Part median(Range range) {
  return {.id = "T1", .name = "test", .measured = "a value", .unit = "times", .confirmed = range};
}
Part share(double least, Range clean) {
  return {.id = "T1",
          .name = "test",
          .measured = "a value",
          .unit = "",
          .statistic = Statistic::kShare,
          .confirmed = {.low = least},
          .clean = clean};
}
Part existence(Range clean) {
  return {.id = "T1",
          .name = "test",
          .measured = "a value",
          .unit = "",
          .statistic = Statistic::kExistence,
          .clean = clean};
}

// `count` cases of each scene, all of the scene's value.
Measurement scenes(const std::vector<double>& values, int count = 4) {
  Measurement measured;
  char name = 'a';
  for (const double value : values) {
    for (int i = 0; i < count; ++i) measured.cases.push_back({std::string(1, name), value});
    ++name;
  }
  return measured;
}

Verdict verdictOf(const Part& part, const Measurement& measured) { return judge(part, measured).verdict; }

constexpr Range kAtMost{.high = 1.1}, kBelow{.high = 1.1, .high_open = true}, kBetween{.low = 1.35, .high = 1.65};

TEST(ClaimVerdict, EqualValuesHaveAnIntervalOfNoWidth) {
  const auto judged = judge(median(kAtMost), scenes({1.1, 1.1, 1.1}));
  EXPECT_EQ(judged.verdict, Verdict::kConfirmed);
  EXPECT_EQ(judged.value, 1.1);
  EXPECT_EQ(judged.low, 1.1);
  EXPECT_EQ(judged.high, 1.1);
  EXPECT_EQ(judged.cases, 12u);
  EXPECT_EQ(judged.scenes, (std::vector<std::string>{"a", "b", "c"}));
  EXPECT_EQ(verdictOf(median(kBelow), scenes({1.1, 1.1, 1.1})), Verdict::kContradicted) << "not below itself";
  EXPECT_EQ(verdictOf(median(kAtMost), scenes({1.2, 1.2, 1.2})), Verdict::kContradicted);
}

TEST(ClaimVerdict, ARangeHasTwoWrongSides) {
  EXPECT_EQ(verdictOf(median(kBetween), scenes({1.4, 1.5, 1.6})), Verdict::kConfirmed);
  EXPECT_EQ(verdictOf(median(kBetween), scenes({1.2, 1.1, 1.3})), Verdict::kContradicted);
  EXPECT_EQ(verdictOf(median(kBetween), scenes({1.7, 1.8, 1.9})), Verdict::kContradicted);
  EXPECT_EQ(verdictOf(median(kBetween), scenes({1.2, 1.5, 1.9})), Verdict::kUndecided) << "on both";
}

// Three scenes, two with 1 and one with 3. A resample has the median 3 if it draws the last scene at least twice:
// probability 3 (1/3)^2 (2/3) + (1/3)^3 = 7/27, more than 5 %. All scenes have equally many cases.
TEST(ClaimVerdict, ResamplesScenesNotCases) {
  const auto judged = judge(median(kAtMost), scenes({1, 1, 3}, 100));
  EXPECT_EQ(judged.verdict, Verdict::kUndecided);
  EXPECT_EQ(judged.value, 1);
  EXPECT_EQ(judged.low, 1);
  EXPECT_EQ(judged.high, 3);
}

// Seven scenes, one of them with 3: it must be drawn four times of seven to matter. Binomial(7, 1/7): 35 (1/7)^4
// (6/7)^3
// + ... = 1.0 %, less than 5 %.
TEST(ClaimVerdict, OneSceneOfSevenDoesNotDecide) {
  EXPECT_EQ(verdictOf(median(kAtMost), scenes({1, 1, 1, 1, 1, 1, 3})), Verdict::kConfirmed);
}

TEST(ClaimVerdict, NeedsTenCasesOfThreeScenes) {
  auto measured = scenes({1, 1, 1}, 3);
  EXPECT_EQ(measured.cases.size(), 9u);
  auto judged = judge(median(kAtMost), measured);
  EXPECT_EQ(judged.verdict, Verdict::kNotMeasurable);
  EXPECT_TRUE(containsAll(judged.reason, {"9 cases of 3 scenes", "10 cases of 3 scenes"}));
  EXPECT_EQ(judged.value, 1) << "the number is kept";
  measured.cases.push_back({"a", 1});
  EXPECT_EQ(verdictOf(median(kAtMost), measured), Verdict::kConfirmed);
  measured.cases.back().value = std::nan("");
  EXPECT_EQ(verdictOf(median(kAtMost), measured), Verdict::kNotMeasurable) << "NaN is no case";
  EXPECT_EQ(verdictOf(median(kAtMost), scenes({1, 1}, 20)), Verdict::kNotMeasurable) << "two scenes";
  EXPECT_TRUE(containsAll(judge(median(kAtMost), {}).reason, {"no case"}));
  EXPECT_EQ(judge(median(kAtMost), cannotMeasure("study x lacks y")).reason, "study x lacks y");
}

TEST(ClaimVerdict, Shares) {
  EXPECT_EQ(verdictOf(share(0.5, kAtMost), scenes({1, 1, 1})), Verdict::kConfirmed);
  EXPECT_EQ(verdictOf(share(0.5, kAtMost), scenes({2, 2, 2})), Verdict::kContradicted);
  // A resample draws the first scene never with probability 8/27, and thrice with 1/27.
  const auto judged = judge(share(0.5, kAtMost), scenes({1, 2, 2}));
  EXPECT_EQ(judged.verdict, Verdict::kUndecided);
  EXPECT_NEAR(judged.value, 1.0 / 3, 1e-15);
  EXPECT_EQ(judged.clean, 4u);
  EXPECT_EQ(judged.low, 0);
  EXPECT_NEAR(judged.high, 2.0 / 3, 1e-15);
}

TEST(ClaimVerdict, ExistenceNeedsOneCase) {
  const Part part = existence({.low = 19.8});
  Measurement measured{{{"a", 3}, {"a", 19.9}}, {}, {}};
  EXPECT_EQ(verdictOf(part, measured), Verdict::kConfirmed);
  EXPECT_EQ(numberText(part, judge(part, measured)), "1 of 2 cases");
  measured.cases.back().value = 19.7;
  EXPECT_EQ(verdictOf(part, measured), Verdict::kNotMeasurable) << "two cases without one prove nothing";
  EXPECT_EQ(verdictOf(part, scenes({1, 2, 3})), Verdict::kContradicted);
}

TEST(ClaimVerdict, InfiniteValuesAreSaidWithTheirCause) {
  const Part part = median(kAtMost);
  Measurement all = scenes({kInfinity, kInfinity, kInfinity});
  all.remark = "9 of 9 runs fail.";
  EXPECT_EQ(numberText(part, judge(part, all)), "infinite");
  EXPECT_EQ(explainedNumber(part, judge(part, all)), "infinite (9 of 9 runs fail.)");
  const Measurement one = scenes({2, 2, kInfinity});
  EXPECT_EQ(numberText(part, judge(part, one)), "2 [2, infinite] times");
  EXPECT_EQ(explainedNumber(part, judge(part, one)), "2 [2, infinite] times");
}

TEST(ClaimVerdict, ReportsHaveNone) {
  const Part part{.id = "T1", .name = "test", .measured = "", .unit = "", .statistic = Statistic::kReport};
  EXPECT_EQ(verdictOf(part, scenes({1}, 1)), Verdict::kReported);
  EXPECT_EQ(verdictOf(part, {}), Verdict::kNotMeasurable);
}

TEST(ClaimVerdict, IsTheSameInEveryOrderAndEveryTime) {
  auto measured = scenes({1, 1.5, 3, 2, 1.2});
  const auto judged = judge(median(kAtMost), measured);
  std::reverse(measured.cases.begin(), measured.cases.end());
  const auto again = judge(median(kAtMost), measured);
  EXPECT_EQ(judged.low, again.low);
  EXPECT_EQ(judged.high, again.high);
}

TEST(ClaimVerdict, OfAllParts) {
  using enum Verdict;
  EXPECT_EQ(combined({kConfirmed, kReported, kConfirmed}), kConfirmed);
  EXPECT_EQ(combined({kConfirmed, kUndecided}), kUndecided);
  EXPECT_EQ(combined({kConfirmed, kUndecided, kNotMeasurable}), kNotMeasurable);
  EXPECT_EQ(combined({kConfirmed, kContradicted, kNotMeasurable}), kContradicted);
  EXPECT_EQ(combined({kDoesNotApply, kReported}), kReported);
  EXPECT_EQ(combined({kDoesNotApply}), kDoesNotApply);
}

TEST(ClaimSensitivity, ScalesThresholds) {
  EXPECT_EQ(scaledThreshold(median({.low = 2}), 0.5).confirmed.low, 1);
  EXPECT_EQ(scaledThreshold(median({.high = 1.1}), 2).confirmed.high, 2.2);
  const auto wide = scaledThreshold(median({.low = 7, .high = 13}), 2).confirmed;
  EXPECT_EQ(wide.low, 4);
  EXPECT_EQ(wide.high, 16);
  EXPECT_NEAR(scaledThreshold(share(0.95, kAtMost), 2).confirmed.low, 0.9, 1e-12);
  EXPECT_NEAR(scaledThreshold(share(0.95, kAtMost), 0.5).confirmed.low, 0.975, 1e-12);
  EXPECT_EQ(scaledThreshold(share(0.3, kAtMost), 2).confirmed.low, 0) << "not below none";
  EXPECT_EQ(scaledThreshold(existence({.high = 1.05}), 2).clean.high, 2.1);
}

TEST(ClaimSensitivity, LeavesScenesOut) {
  const auto measured = scenes({1, 1, 3, 3, 3});
  EXPECT_EQ(verdictOf(median(kAtMost), measured), Verdict::kUndecided);
  const auto sensitivity = sensitivityOf(median(kAtMost), scenes({1, 1, 3}));
  EXPECT_EQ(sensitivity.halved, Verdict::kContradicted);
  EXPECT_EQ(sensitivity.doubled, Verdict::kUndecided);
  ASSERT_EQ(sensitivity.without.size(), 3u);
  EXPECT_EQ(sensitivity.without[0].first, "a");
  EXPECT_EQ(sensitivity.without[0].second.verdict, Verdict::kUndecided);
  EXPECT_EQ(sensitivity.without[2].second.verdict, Verdict::kConfirmed) << "without c both left agree";
}

}  // namespace
}  // namespace irk::claims
