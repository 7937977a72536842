// Which runs of a series are skipped.
#include "experiments/study/series_walk.h"

#include <gtest/gtest.h>

#include "experiments/study/study_reader.h"
#include "irk/outcome.h"

namespace irk {
namespace {

// The run of five after which all others are skipped, if the runs have these outcomes; -1: none.
int skipsAfter(const std::vector<Outcome>& outcomes) {
  const Study study = parseStudy(
      "[[block]]\nname = \"b\"\nscene = \"kepler\"\nconfiguration = \"embedded\"\nmethods = \"radau_iia_3\"\n"
      "tolerances = [1e-2, 1e-3, 1e-4, 1e-5, 1e-6]\n",
      "mine.toml", StudyVariant::kFull);
  EXPECT_EQ(study.series.size(), 1u);
  const Series series = study.series[0];
  EXPECT_EQ(series.end, SeriesEnd::kTooLong);
  EXPECT_EQ(series.runs.size(), outcomes.size());
  SeriesWalk walk(series);
  for (const Outcome outcome : outcomes) walk.record(walk.next().value(), {std::string(name(outcome))});
  EXPECT_FALSE(walk.next());
  return walk.tooLong() ? static_cast<int>(*walk.tooLong()) : -1;
}

TEST(SeriesWalk, EndsAfterTwoRunsInARowThatTookTooLong) {
  constexpr Outcome kGood = Outcome::kSuccess, kSlow = Outcome::kTimeout, kMany = Outcome::kMaxSteps;
  EXPECT_EQ(skipsAfter({kGood, kGood, kGood, kGood, kGood}), -1);
  EXPECT_EQ(skipsAfter({kSlow, kGood, kMany, kGood, kSlow}), -1);
  EXPECT_EQ(skipsAfter({kGood, kGood, kGood, kSlow, kMany}), 4);
  EXPECT_EQ(skipsAfter({kGood, kSlow, kMany, kMany, kMany}), 2);  // the last two are not made
  EXPECT_EQ(skipsAfter({kGood, kGood, Outcome::kNewtonFailed, Outcome::kNewtonFailed, kSlow}), -1);
}

}  // namespace
}  // namespace irk
