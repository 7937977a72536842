// Errors at several times of one run, against runs to each of these times.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "experiments/runs/fields.h"
#include "experiments/runs/run.h"

namespace irk {
namespace {

RunSpec withTimes(const char* text, int times) {
  RunSpec spec = parseSpec(text);
  spec.reference_times = times;
  return spec;
}

TEST(ErrorsOverTime, AreTheLargestOfRunsToEachTime) {
  for (const char* text : {"scene=pendulum;t_end=2;method=radau_iia_3;rtol=1e-6;atol=1e-6",
                           "scene=pendulum;t_end=2;configuration=embedded;method=radau_iia_5;rtol=1e-8;atol=1e-8",
                           "scene=kepler;t_end=20;method=cvode_bdf;rtol=1e-5;atol=1e-5",
                           "scene=stick_slip;t_end=20;rtol=1e-6;atol=1e-6"}) {
    const RunRecord run = execute(withTimes(text, 10));
    ASSERT_TRUE(run.succeeded()) << text << run.detail;
    RunErrors largest;
    largest.all = largest.u = largest.v = 0;
    bool falls = false;  // an earlier error is larger: the last one alone is not the answer
    for (int k = 1; k <= 10; ++k) {
      RunSpec one = parseSpec(text);
      one.t_end = one.t_end * k / 10;
      const RunErrors errors = execute(one).errors;
      largest.all = std::max(largest.all, errors.all);
      largest.u = std::max(largest.u, errors.u);
      largest.v = std::max(largest.v, errors.v);
      falls = falls || errors.all > run.errors.all;
    }
    EXPECT_EQ(run.errors_over_time.all, largest.all) << text;
    EXPECT_EQ(run.errors_over_time.u, largest.u) << text;
    EXPECT_EQ(run.errors_over_time.v, largest.v) << text;
    EXPECT_TRUE(falls || run.errors.all == largest.all) << text;
  }
}

TEST(ErrorsOverTime, AreThoseAtTheEndWithOneTime) {
  const RunRecord run = execute(withTimes("scene=kepler;t_end=10;rtol=1e-6;atol=1e-6", 1));
  EXPECT_GT(run.errors.all, 0);
  EXPECT_EQ(run.errors_over_time.all, run.errors.all);
}

TEST(ErrorsOverTime, DoNotChangeTheRun) {
  const char* text = "scene=pendulum;t_end=2;rtol=1e-8;atol=1e-8";
  const RunRecord one = execute(withTimes(text, 1)), ten = execute(withTimes(text, 10));
  EXPECT_EQ(one.u, ten.u);
  EXPECT_EQ(one.errors.all, ten.errors.all);
  EXPECT_EQ(one.counters.residuals, ten.counters.residuals);
  EXPECT_GT(ten.errors_over_time.all, ten.errors.all * 0.999);
}

TEST(ErrorsOverTime, AreUnknownIfOneIs) {
  // Known at the end, but not at a seventh of it.
  const RunRecord run = execute(withTimes("scene=hires;rtol=1e-4;atol=1e-4", 7));
  ASSERT_TRUE(run.succeeded()) << run.detail;
  EXPECT_FALSE(std::isnan(run.errors.all));
  EXPECT_TRUE(std::isnan(run.errors_over_time.all));
}

TEST(ErrorsOverTime, OfAFailedRunAreUnknown) {
  const RunRecord run = execute(withTimes("scene=kepler;max_steps=20;rtol=1e-8;atol=1e-8", 10));
  EXPECT_EQ(run.outcome, "max_steps");
  EXPECT_TRUE(std::isnan(run.errors_over_time.all));
}

TEST(ErrorsOverTime, AskForTheReferenceOfEachTime) {
  const RunSpec spec = withTimes("scene=mechanical_dae;t_end=0.07;rtol=1e-4;atol=1e-4;reference=auto", 7);
  std::vector<double> asked;
  Watch watch;
  watch.reference = [&](const RunSpec& run) -> MadeReference {
    asked.push_back(run.t_end);
    // All these references are wrong, that in the middle most.
    return {{{run.t_end, "x", std::abs(run.t_end - 0.04) < 1e-9 ? "1e3" : "1", 1e-20, {}}}, {}};
  };
  const RunRecord run = execute(spec, watch);
  ASSERT_TRUE(run.succeeded()) << run.detail;
  std::sort(asked.begin(), asked.end());
  ASSERT_EQ(asked.size(), 7u);
  for (std::size_t k = 0; k < 7; ++k) EXPECT_NEAR(asked[k], 0.01 * static_cast<double>(k + 1), 1e-15);
  const auto runs = atReferenceTimes(resolved(spec));
  ASSERT_EQ(runs.size(), 7u);
  EXPECT_EQ(runs.back().t_end, 0.07);
  for (std::size_t k = 0; k < 7; ++k) EXPECT_EQ(runs[k].t_end, asked[k]) << "the runner makes these before";
}

TEST(LargerErrors, LeaveOutErrorsThatAreNotMeasurable) {
  RunErrors known, small;
  known.all = known.u = 1e-3;
  known.accuracy = 1e-9;
  small.accuracy = 1e-8;
  known.reference = small.reference = ReferenceKind::kComputed;
  for (const auto& larger : {largerErrors(known, small), largerErrors(small, known)}) {
    EXPECT_EQ(larger.all, 1e-3);
    EXPECT_EQ(larger.u, 1e-3);
    EXPECT_TRUE(std::isnan(larger.v));
    EXPECT_EQ(larger.accuracy, 1e-8);
  }
  EXPECT_TRUE(std::isnan(largerErrors(known, {}).all));
  EXPECT_TRUE(std::isnan(largerErrors({}, known).all));
}

}  // namespace
}  // namespace irk
