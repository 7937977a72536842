// The suite's best configuration, at the tolerances that the IVP test set uses.
#include <gtest/gtest.h>

#include <cmath>

#include "experiments/runs/fields.h"
#include "experiments/runs/run.h"
#include "irk/collections.h"

namespace irk {
namespace {

// Local errors accumulate; as the test set measures it, an error of a code that follows its tolerance is at most this
// many tolerances.
constexpr double kMost = 100;

TEST(TestSetTolerances, VariableOrderSolvesEverySceneOfTheTestSet) {
  const auto scenes = scenesOf("ivp");
  EXPECT_GE(scenes.size(), 17u);
  for (const auto& scene : scenes) {
    for (const char* tolerance : {"1e-4", "1e-6", "1e-8", "1e-10"}) {
      SCOPED_TRACE(scene + " at " + tolerance);
      const RunRecord run = execute(parseSpec(
          "scene=" + scene + ";configuration=variable;method=radau_iia;rtol=" + tolerance + ";atol=" + tolerance));
      ASSERT_TRUE(run.succeeded()) << run.detail;
      EXPECT_LE(std::pow(10, -run.errors.mescd()), kMost * std::stod(tolerance));
    }
  }
}

}  // namespace
}  // namespace irk
