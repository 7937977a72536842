// Switches without a valid mode: the outcome is `chattering`.
#include <gtest/gtest.h>

#include "tests/core/switching_run.h"
#include "tests/refusal.h"

namespace irk::test {
namespace {

/// x' = 1 - 2 sigma with sigma = [x > 0]: once x reaches 0 it can only slide, for which there is no mode.
struct Sliding {
  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0, .discrete = 1, .switches = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = 1.0 - 2.0 * p.d[0] - p.k[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = p.d[0] == T(0.0) ? T(p.x[0]) : T(-1.0);
    g[1] = p.d[0] == T(0.0) ? T(-1.0) : T(-p.x[0]);
  }
  template <class T>
  void onSwitch(Index i, const Point<T>&, T* d) const {
    d[0] = i == 0 ? T(1.0) : T(0.0);
  }
  std::string switchName(Index i) const { return i == 0 ? "rise" : "fall"; }
};

TEST(Chattering, IsNamed) {
  const Sliding problem;
  const auto start = startOf(problem, {.x = {-0.5}});
  for (const double tol : {1e-3, 1e-9}) {
    EXPECT_EQ(run(problem, start, 1, Discontinuity::kLocate, adaptive(tol)).solution.outcome, Outcome::kChattering)
        << tol;
  }
  const Result located = run(problem, start, 1, Discontinuity::kLocate, adaptive(1e-6));
  EXPECT_EQ(located.solution.outcome, Outcome::kChattering);
  EXPECT_NEAR(located.solution.state.t, 0.5, 1e-6);
  EXPECT_NE(located.solution.detail.find('\''), std::string::npos) << located.solution.detail;
  EXPECT_EQ(located.solution.counters.chattering, 1);

  const Result iterated = run(problem, start, 1, Discontinuity::kIterate, adaptive(1e-6));
  EXPECT_EQ(iterated.solution.outcome, Outcome::kChattering);
  // There the stage equations of the discontinuous law have no solution: the run must fail, not return a wrong
  // result.
  IntegratorOptions options = adaptive(1e-6);
  options.step.max_steps = 2000;
  const Result ignored = run(problem, start, 1, Discontinuity::kIgnore, options);
  EXPECT_NE(ignored.solution.outcome, Outcome::kSuccess);
  EXPECT_NEAR(ignored.solution.state.t, 0.5, 1e-2);
}

/// A relay that changes sides at every whole multiple of 1/1000.
struct Ticker {
  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0, .discrete = 2, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = p.d[0] - p.k[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = p.t - p.d[1];
  }
  template <class T>
  void onSwitch(Index, const Point<T>& p, T* d) const {
    d[0] = -p.d[0];
    d[1] = p.d[1] + 1e-3;
  }
  std::string switchName(Index) const { return "tick"; }
};

TEST(Chattering, SwitchesInEveryStepAreNoted) {
  const Ticker problem;
  const auto start = startOf(problem, {.d = {1, 0.5e-3}});
  IntegratorOptions options = fixedSteps(1e-3);
  const Result r = run(problem, start, 0.1, Discontinuity::kIgnore, options);
  ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
  EXPECT_EQ(r.solution.counters.switches, 100);
  EXPECT_EQ(r.events.size(), 100u);
  EXPECT_EQ(r.solution.counters.chattering, 1);
  EXPECT_TRUE(contains(r.solution.detail, "'tick'"));
  options.step.h = 5e-2;  // 50 located switches in a step are no chattering
  const Result located = run(problem, start, 0.1, Discontinuity::kLocate, options);
  ASSERT_EQ(located.solution.outcome, Outcome::kSuccess) << located.solution.detail;
  EXPECT_EQ(located.solution.counters.located_events, 100);
  EXPECT_EQ(located.solution.counters.chattering, 0);
}

/// From t = 0.5 on the switch of each mode is due at once.
struct NoMode : Sliding {
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = p.t > T(0.5) && p.d[0] == T(0.0) ? T(1.0) : T(-1.0);
    g[1] = p.t > T(0.5) && p.d[0] != T(0.0) ? T(1.0) : T(-1.0);
  }
};

TEST(Chattering, NoValidModeEndsTheRun) {
  const NoMode problem;
  const State<double> start(problem.sizes());
  for (const Discontinuity mode : {Discontinuity::kLocate, Discontinuity::kIterate}) {
    const Result r = run(problem, start, 1, mode, adaptive(1e-6));
    EXPECT_EQ(r.solution.outcome, Outcome::kChattering) << idOf(mode);
    EXPECT_NEAR(r.solution.state.t, 0.5, 1e-3) << idOf(mode);
    EXPECT_TRUE(contains(r.solution.detail, "switching function"));
  }
}

TEST(Smooth, RefusedWithoutRegularisation) {
  EXPECT_THROW(makeSystem<double>(Sliding{}, {Formulation::kIndex2, ConstraintScaling::kOn, Discontinuity::kSmooth}),
               Misuse);
}

}  // namespace
}  // namespace irk::test
