// The cost of the four runs of a reference, as it is expected while they are made, and their early end.
#include "experiments/reference/attempt.h"

#include <gtest/gtest.h>

#include <cmath>

#include "experiments/runs/fields.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

TEST(ReferenceCourse, IsThePartOfTheSteps) {
  EXPECT_FALSE(Course().known());
  EXPECT_FALSE(Course({1}).known());
  const Course course({0, 1, 1, 3, 100});  // four steps, one of them made twice
  ASSERT_TRUE(course.known());
  for (const auto& [t, part] : {std::pair(-1.0, 0.0),
                                {0.0, 0.0},
                                {0.5, 0.125},
                                {1.0, 0.5},
                                {2.0, 0.625},
                                {3.0, 0.75},
                                {51.5, 0.875},
                                {100.0, 1.0},
                                {101.0, 1.0}}) {
    EXPECT_DOUBLE_EQ(course.part(t), part) << t;
  }
}

TEST(ReferenceCourse, FollowsTheSolutionNotTheTime) {
  const Course course = courseOf({"robertson", {}, 1e6}, 10, nullptr);
  ASSERT_TRUE(course.known());
  EXPECT_GT(course.part(1e3), 0.3) << "a thousandth of the time";
  EXPECT_LT(course.part(1e3), 0.9);
  EXPECT_FALSE(courseOf({"robertson", {}, 1e6}, 1e-9, nullptr).known()) << "it may take no time";
}

const Course kEven({0, 10});

// The runs 0 and 1 are the looser ones; a stricter one costs 1.3 times as much: all cost 4.6 times the first.
TEST(ReferenceCosts, AreExpectedFromTheLooserRuns) {
  AttemptCosts costs(100, kEven);
  EXPECT_EQ(costs.reached(0, 0.1, 1), "");
  EXPECT_TRUE(std::isnan(costs.expected())) << "too early";
  EXPECT_EQ(costs.reached(0, 5, 8), "");
  EXPECT_DOUBLE_EQ(costs.expected(), 16 * 4.6);
  EXPECT_EQ(costs.reached(1, 10, 20), "");
  EXPECT_DOUBLE_EQ(costs.expected(), (16 + 20) * 4.6 / 2);
  EXPECT_EQ(costs.reached(2, 5, 13), "");
  EXPECT_DOUBLE_EQ(costs.expected(), (16 + 20 + 26) * 4.6 / 3.3);
  EXPECT_DOUBLE_EQ(costs.spent(), 41);
}

TEST(ReferenceCosts, EndTheRunsThatWillTakeTooLong) {
  AttemptCosts early(100, kEven);
  EXPECT_EQ(early.reached(0, 0.5, 2.9), "") << "so little says nothing";
  EXPECT_EQ(early.reached(0, 1, 3.2), "") << "147 s: an early estimate may be wrong by so much";
  EXPECT_EQ(early.reached(0, 1, 5), "it would take about 230 s of CPU time, more than 100");
  AttemptCosts late(100, kEven);
  EXPECT_EQ(late.reached(0, 10, 22), "");
  EXPECT_EQ(late.reached(1, 7, 18.2), "") << "110 s";
  EXPECT_EQ(late.reached(1, 9, 36), "it would take about 143 s of CPU time, more than 100");
  AttemptCosts unknown(100, Course());
  EXPECT_EQ(unknown.reached(0, 1, 60), "");
  EXPECT_EQ(unknown.reached(3, 1, 40.5), "longer than 100 s of CPU time") << "together";
}

// One of the four can make 20 steps of 1/100 only between two times: the others stop where it has failed.
TEST(ReferenceAttempt, KeepsWhatWasReachedBeforeAFailure) {
  const auto spec = resolved(parseSpec("scene=kaps;method=radau_iia_2;control=fixed;estimate=none;h=0.01"));
  ReferenceSpecs specs{spec, spec, spec, spec};
  specs[1].options.step.max_steps = 20;
  const auto made = attempt(specs, {"0.1", "0.2", "0.9", "1"}, {});
  EXPECT_TRUE(containsAll(made.failure, {"radau_iia_2", "max_steps"})) << made.failure;
  EXPECT_EQ(made.runs[0].rows.size(), 4u) << "made before";
  for (const std::size_t i : {1U, 2U, 3U}) EXPECT_EQ(made.runs[i].rows.size(), 2u) << i;
}

}  // namespace
}  // namespace irk
