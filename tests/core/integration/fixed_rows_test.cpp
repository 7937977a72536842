// Rows that no (a, k, z) can satisfy, after a mode has changed: 0 = x - f(t) with a jump of f has no solution.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/core/support.h"
#include "tests/refusal.h"

namespace irk::test {
namespace {

/// x' = z, 0 = x - f(t), f = sin t, and from t = 0.5 on sin t + gap - (t - 0.5): x = f and z = f', which is cos t - 1
/// then. The change is at a declared time, or, `by_switch`, at a switching function.
struct Follower {
  double gap;
  bool by_switch = false;
  static constexpr int kAlgebraicIndex = 2;
  Sizes sizes() const { return {.nx = 1, .nz = 1, .discrete = 1, .switches = by_switch ? 1 : 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sin;
    r.x[0] = p.z[0] - p.k[0];
    r.z[0] = p.x[0] - sin(p.t) - p.d[0] * (gap - (p.t - 0.5));
  }
  std::vector<double> times() const { return by_switch ? std::vector<double>{} : std::vector<double>{0.5}; }
  template <class T>
  void onTime(Index, const Point<T>&, T* d) const {
    d[0] = T(1);
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    if (by_switch) g[0] = p.d[0] > T(0) ? T(-1) : T(p.t - 0.5);
  }
  template <class T>
  void onSwitch(Index, const Point<T>&, T* d) const {
    d[0] = T(1);
  }
};

State<double> followerStart(double x = 0) {
  State<double> s(Follower{0}.sizes());
  s.x[0] = x;
  s.w << 1, 1;
  return s;
}
Solution<double> followJump(const Follower& problem, const IntegratorOptions& options, double x = 0) {
  return integrate<double>(problem, followerStart(x), 1, makeTableau<double>("radau_iia_3"), options);
}

TEST(FixedRows, AJumpThatNoUnknownCanFollowEndsTheRun) {
  for (const bool by_switch : {false, true}) {
    for (const IntegratorOptions& options : {adaptive(1e-4), adaptive(1e-8), embedded(1e-6), fixedSteps(0.01)}) {
      for (const double gap : {0.4, -1e-2}) {
        const Solution<double> s = followJump({gap, by_switch}, options);
        EXPECT_EQ(name(s.outcome), "inconsistent_start") << s.detail;
        EXPECT_TRUE(contains(s.detail, "row 1 = "));
        EXPECT_TRUE(contains(s.detail, "at t = 0.5, allowed"));
        EXPECT_NEAR(s.state.t, 0.5, 1e-6);
      }
    }
  }
}

// A kink, at which z jumps from cos t to cos t - 1, is followed.
TEST(FixedRows, AKinkIsFollowed) {
  for (const bool by_switch : {false, true}) {
    for (const IntegratorOptions& options : {adaptive(1e-4), adaptive(1e-8), embedded(1e-6), fixedSteps(0.01)}) {
      const Solution<double> s = followJump({0, by_switch}, options);
      ASSERT_EQ(s.outcome, Outcome::kSuccess) << s.detail;
      EXPECT_NEAR(s.state.x[0], std::sin(1.0) - 0.5, 1e-6);
      EXPECT_NEAR(s.state.z()[0], std::cos(1.0) - 1, 1e-2);
    }
  }
}

TEST(FixedRows, AStartOffTheRowIsInconsistent) {
  for (const IntegratorOptions& options : {adaptive(1e-4), fixedSteps(0.01)}) {
    const Solution<double> off = followJump({0}, options, 1e-3);
    EXPECT_EQ(name(off.outcome), "inconsistent_start");
    EXPECT_TRUE(contains(off.detail, "at the start: row 1 = 0.001 at t = 0"));
    EXPECT_EQ(followJump({0}, options, 1e-9).outcome, Outcome::kSuccess);
  }
}

}  // namespace
}  // namespace irk::test
