// A problem with more discrete states and switching functions than fit into fixed memory.
#include <gtest/gtest.h>

#include "tests/core/located.h"

namespace irk::test {
namespace {

constexpr Index kTanks = 18;

/// Tanks of water that empty at t_i = 1 + i / 10 and then stay empty. The level falls by (2 t_i - t) / t_i^2, from 3/2
/// at t = 0.
struct Tanks {
  static double emptyAt(Index i) { return 1 + 0.1 * static_cast<double>(i); }

  Sizes sizes() const { return {.nx = kTanks, .discrete = kTanks, .switches = kTanks}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    for (Index i = 0; i < kTanks; ++i) {
      r.x[i] = (p.d[i] > T(0.0) ? T(0.0) : T((p.t - 2 * emptyAt(i)) / (emptyAt(i) * emptyAt(i)))) - p.k[i];
    }
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    for (Index i = 0; i < kTanks; ++i) g[i] = p.d[i] > T(0.0) ? T(-1.0) : T(-p.x[i]);
  }
  template <class T>
  void onSwitch(Index i, const Point<T>&, T* d) const {
    d[i] = T(1.0);
  }
};

State<double> fullTanks() {
  State<double> start(Tanks{}.sizes());
  start.x.setConstant(1.5);
  return start;
}

TEST(ManySwitches, EachIsLocatedInItsTurn) {
  const auto [solution, events] = run(Tanks{}, fullTanks(), 4, Discontinuity::kLocate, located(1e-8));
  ASSERT_EQ(solution.outcome, Outcome::kSuccess);
  ASSERT_EQ(events.size(), static_cast<std::size_t>(kTanks));
  for (Index i = 0; i < kTanks; ++i) {
    EXPECT_EQ(events[static_cast<std::size_t>(i)].index, i);
    EXPECT_NEAR(events[static_cast<std::size_t>(i)].t, Tanks::emptyAt(i), 1e-9);
    EXPECT_NEAR(solution.state.x[i], 0, 1e-9);
  }
}

// Here the problem's own functions are asked for the mode in each evaluation of the residual.
TEST(ManySwitches, AreImpliedWhereTheyAreNotLocated) {
  const auto [solution, events] = run(Tanks{}, fullTanks(), 4, Discontinuity::kIgnore, adaptive(1e-6));
  ASSERT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
  for (Index i = 0; i < kTanks; ++i) EXPECT_NEAR(solution.state.x[i], 0, 1e-4) << i;
}

}  // namespace
}  // namespace irk::test
