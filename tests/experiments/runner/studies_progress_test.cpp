#include "experiments/base/studies_progress.h"

#include <gtest/gtest.h>

namespace irk {
namespace {

TEST(StudiesProgress, CountsRunsOfAllStudiesAndTheTimeLeft) {
  const StudiesProgress progress({{"scenes", 10}, {"order", 60}, {"beam", 30}});
  EXPECT_EQ(progress.line(0, 0), "study 1 of 3, scenes: 0 of 100 runs done");
  EXPECT_EQ(progress.line(1, 20), "study 2 of 3, order: 10 of 100 runs done, about 3:00 left for all studies");
  EXPECT_EQ(progress.line(2, 140), "study 3 of 3, beam: 70 of 100 runs done, about 1:00 left for all studies");
}

TEST(StudiesProgress, TakesTheExpectedTimeOfARun) {
  const StudiesProgress progress({{"scenes", 50, 0.01}, {"order", 10, 30}, {"beam", 40, 15}});
  EXPECT_EQ(progress.line(1, 3), "study 2 of 3, order: 50 of 100 runs done") << "too early";
  EXPECT_EQ(progress.line(2, 60), "study 3 of 3, beam: 60 of 100 runs done, about 2:00 left for all studies");
}

TEST(StudiesProgress, StudiesWithoutRunsDivideByNothing) {
  EXPECT_EQ(StudiesProgress({{"empty", 0}}).line(0, 0), "study 1 of 1, empty: 0 of 0 runs done");
}

}  // namespace
}  // namespace irk
