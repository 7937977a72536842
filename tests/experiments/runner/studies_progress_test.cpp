#include "experiments/base/studies_progress.h"

#include <gtest/gtest.h>

namespace irk {
namespace {

TEST(StudiesProgress, CountsRunsOfAllStudiesAndTheTimeLeft) {
  const StudiesProgress progress({{"scenes", 10}, {"order", 60}, {"beam", 30}});
  EXPECT_EQ(progress.line(0, 0), "study 1 of 3, scenes: 0 of 100 runs done, 0 %");
  EXPECT_EQ(progress.line(1, 20), "study 2 of 3, order: 10 of 100 runs done, 10 %, about 3:00 left for all studies");
  EXPECT_EQ(progress.line(2, 140), "study 3 of 3, beam: 70 of 100 runs done, 70 %, about 1:00 left for all studies");
}

TEST(StudiesProgress, StudiesWithoutRunsDivideByNothing) {
  EXPECT_EQ(StudiesProgress({{"empty", 0}}).line(0, 0), "study 1 of 1, empty: 0 of 0 runs done, 100 %");
}

}  // namespace
}  // namespace irk
