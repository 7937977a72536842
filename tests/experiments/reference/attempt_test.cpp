// The four runs of a reference, and their early end.
#include "experiments/reference/attempt.h"

#include <gtest/gtest.h>

#include "experiments/runs/fields.h"
#include "tests/experiments/support.h"

namespace irk {
namespace {

TEST(ReferenceAttempt, EndsAtItsLimit) {
  const auto spec = resolved(parseSpec("scene=kaps;method=radau_iia_2;control=fixed;estimate=none;h=1e-4"));
  const ReferenceSpecs specs{spec, spec, spec, spec};
  double spent = 0;
  const auto made = attempt(specs, {"0.2", "10"}, {.cpu_s = 1e-3, .progress = [&](double cpu_s) { spent = cpu_s; }});
  EXPECT_TRUE(containsAll(made.failure, {"radau_iia_2", "timeout", "the four runs", "0.001 s of CPU time"}));
  EXPECT_FALSE(made.hasReached(1));
  EXPECT_GT(spent, 0);
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
