// The changes of a residual caused by weighted changes of a state.
#include "core/derivatives/weighted_changes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace irk::test {
namespace {

constexpr Sizes kTwo{.nu = 0, .nx = 2};

Vec<double> changes(const Vec<double>& x, const Vec<double>& weights,
                    const std::function<Vec<double>(const Vec<double>&)>& r) {
  State<double> state(kTwo), by(kTwo);
  state.x = x;
  by.x = weights;
  return weightedChanges<double>(state, by, r(x), [&](const State<double>& at) { return r(at.x); });
}

// The numbers are of another program's Park-Miller generator: the same directions on every platform.
TEST(WeightedChanges, AreThoseOfAllComponentsTogether) {
  const auto found = changes(Vec<double>::Zero(2), Vec<double>{{1, 2}}, [](const Vec<double>& x) {
    return Vec<double>{{x[0], x[0] + x[1]}};
  });
  EXPECT_NEAR(found[0], 1.10681737844028, 1e-13);
  EXPECT_NEAR(found[1], 2.68807983661048, 1e-13);
  EXPECT_NEAR(found[0], 1, 0.2);
  EXPECT_NEAR(found[1], std::sqrt(5), 1);
}

TEST(WeightedChanges, LeaveOutDirectionsWithoutAFiniteResidual) {
  const auto found = changes(Vec<double>{{0.01, 0}}, Vec<double>{{0.1, 0}}, [](const Vec<double>& x) {
    return Vec<double>{{std::sqrt(x[0]), std::sqrt(-1 - std::abs(x[0] - 0.01))}};
  });
  EXPECT_NEAR(found[0], 0.248136974237593, 1e-13);
  EXPECT_EQ(found[1], 0) << "no direction is left: nothing is allowed";
}

TEST(WeightedChanges, NeitherOverflowNorUnderflow) {
  for (const double factor : {1e-170, 1e165}) {
    const auto found = changes(Vec<double>::Zero(2), Vec<double>{{1, 1}},
                               [&](const Vec<double>& x) { return Vec<double>(factor * x); });
    EXPECT_NEAR(found[0] / factor, 1, 0.2) << factor;
  }
}

}  // namespace
}  // namespace irk::test
