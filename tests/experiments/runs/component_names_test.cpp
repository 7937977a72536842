#include "experiments/runs/texts/component_names.h"

#include <gtest/gtest.h>

namespace irk {
namespace {

const Sizes kScene{.nu = 2, .nx = 1, .nz = 1};
const std::vector<std::string> kNames{"theta", "phi", "theta'", "phi'", "i", "lambda"};

std::string named(const std::string& message, const Sizes& system) {
  return withNames(message, kNames, kScene, system);
}

TEST(ComponentNames, AreThoseOfTheScene) {
  EXPECT_EQ(named("largest error in u[1]) at t = 2", kScene), "largest error in phi) at t = 2");
  EXPECT_EQ(named("v[0], x[0] and z[0]", kScene), "theta', i and lambda");
  EXPECT_EQ(named("nothing here", kScene), "nothing here");
}

// Formulations of first order have (u, v, x) as x; GGL has multipliers of its own.
TEST(ComponentNames, OfFormulationsOfFirstOrder) {
  const Sizes ggl{.nu = 0, .nx = 5, .nz = 2};
  EXPECT_EQ(named("x[0] x[3] x[4] z[0] z[1]", ggl), "theta phi' i lambda GGL's multiplier 0");
  EXPECT_EQ(named("at the start: x[0] = nan", ggl), "at the start: i = nan");
}

TEST(ComponentNames, UnknownComponentsKeepTheirNames) {
  EXPECT_EQ(named("u[2] x[1] z[7] g[0] index[3]", kScene), "u[2] x[1] z[7] g[0] index[3]");
}

}  // namespace
}  // namespace irk
