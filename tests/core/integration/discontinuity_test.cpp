// Switches: all treatments on systems with exact switching times, and all ways in which switches can go wrong.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/core/switching_run.h"
#include "tests/refusal.h"

namespace irk::test {
namespace {

/// Free fall from height 1 with g = 2 on a linear spring: flight s = 1 - t^2, contact at t = 1 with velocity -2; then
/// m s'' = -k s - 2, until s = 0 again.
struct Bounce {
  double k = 400;
  double ground = 0;  ///< what the switching function returns instead, to damage it
  Sizes sizes() const { return {.nu = 1, .nx = 0, .nz = 0, .constraints = 0, .discrete = 1, .switches = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -2.0 - k * (p.d[0] * p.u[0]) - p.a[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = p.d[0] > T(0.5) ? T(-1.0) : T(-p.u[0] + ground);
    g[1] = p.d[0] > T(0.5) ? T(p.u[0]) : T(-1.0);
  }
  template <class T>
  void onSwitch(Index i, const Point<T>&, T* d) const {
    d[0] = i == 0 ? T(1.0) : T(0.0);
  }
  template <class T>
  void smoothed(const Point<T>& p, T* d) const {
    using std::tanh;
    d[0] = (1.0 - tanh(p.u[0] * 1e7)) * 0.5;
  }
  std::string switchName(Index i) const { return i == 0 ? "contact" : "release"; }
};

State<double> height(const Bounce& problem, double u) { return startOf(problem, {.u = {u}}); }

// Follows from the spring's equation with s(0) = 0, s'(0) = -2: s = -c + c cos wt - (2/w) sin wt, c = 2/k.
double contactTime(double k) {
  const double w = std::sqrt(k);
  return (2 * std::acos(-1.0) - 2 * std::atan2(2 / w, 2 / k)) / w;
}

TEST(Locate, FindsSwitchesToRoundOff) {
  const Bounce problem;
  for (const char* method : {"radau_iia_3", "radau_iia_7", "gauss_4", "lobatto_iiia_4"}) {
    const Result r = run(problem, height(problem, 1), 3, Discontinuity::kLocate, adaptive(1e-10), method);
    ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << method << r.solution.detail;
    ASSERT_EQ(r.events.size(), 2u) << method;
    EXPECT_NEAR(r.events[0].t, 1, 1e-11) << method;
    EXPECT_EQ(r.events[0].index, 0);
    EXPECT_NEAR(r.events[1].t, 1 + contactTime(problem.k), 1e-10) << method;
    EXPECT_EQ(r.events[1].index, 1);
    EXPECT_EQ(r.solution.counters.located_events, 2) << method;
    EXPECT_EQ(r.solution.counters.switches, 2) << method;
    // Flight with speed 2 again.
    const double flight = 3 - r.events[1].t;
    EXPECT_NEAR(r.solution.state.u[0], 2 * flight - flight * flight, 1e-8) << method;
  }
}

// `ignore` and `smooth` leave the kinks to step doubling. It does not detect a kink before the first stage of both
// the whole step and its first half, so the error may be far above tol.
TEST(Modes, ConvergeWithTheTolerance) {
  const Bounce problem;
  const double flight = 2 - contactTime(problem.k);
  const double exact = 2 * flight - flight * flight;
  const auto errorOf = [&](Discontinuity mode, double tol) {
    const Result r = run(problem, height(problem, 1), 3, mode, adaptive(tol));
    EXPECT_EQ(r.solution.outcome, Outcome::kSuccess) << idOf(mode) << r.solution.detail;
    return std::abs(r.solution.state.u[0] - exact);
  };
  for (const double tol : {1e-4, 1e-6, 1e-8}) {
    EXPECT_LT(errorOf(Discontinuity::kLocate, tol), 100 * tol) << tol;
    EXPECT_LT(errorOf(Discontinuity::kIterate, tol), 300 * tol) << tol;
    EXPECT_LT(errorOf(Discontinuity::kIgnore, tol), 1e4 * tol) << tol;
    EXPECT_LT(errorOf(Discontinuity::kSmooth, tol), 1e4 * tol) << tol;
  }
}

TEST(Iterate, CountsItsIterations) {
  const Bounce problem;
  const Result r = run(problem, height(problem, 1), 3, Discontinuity::kIterate, adaptive(1e-6));
  EXPECT_GE(r.solution.counters.discontinuous_iterations, 2);
  EXPECT_EQ(r.solution.counters.switches, 2);
  EXPECT_EQ(r.solution.counters.located_events, 0);
}

TEST(Locate, FixedStepsAreSplit) {
  const Bounce problem;
  const Result r = run(problem, height(problem, 1), 3, Discontinuity::kLocate, fixedSteps(0.03));
  ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
  ASSERT_EQ(r.events.size(), 2u);
  EXPECT_NEAR(r.events[0].t, 1, 1e-12);
  EXPECT_NEAR(r.events[1].t, 1 + contactTime(problem.k), 1e-5);
  EXPECT_EQ(r.solution.state.t, 3);
  EXPECT_EQ(r.solution.counters.steps_accepted, 102);
}

TEST(Locate, SwitchAtTheStartHappensThere) {
  const Bounce problem;
  State<double> start = height(problem, -1e-3);  // in contact, but in the mode of flight
  const Result r = run(problem, start, 0.01, Discontinuity::kLocate, adaptive(1e-8));
  ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
  ASSERT_GE(r.events.size(), 1u);
  EXPECT_EQ(r.events[0].t, 0);
  // Exactly on the switching surface, moving into the spring.
  start = height(problem, 0);
  start.v[0] = -1;
  const Result on = run(problem, start, 0.01, Discontinuity::kLocate, adaptive(1e-8));
  ASSERT_EQ(on.solution.outcome, Outcome::kSuccess) << on.solution.detail;
  ASSERT_GE(on.events.size(), 1u);
  EXPECT_NEAR(on.events[0].t, 0, 1e-14);
}

// The start lies on the switching surface and the switch is due at once: g = t.
TEST(Locate, SwitchDueRightAfterTheStart) {
  const OnFor problem{0, 0.2};
  const State<double> start(problem.sizes());
  const Result r = run(problem, start, 1, Discontinuity::kLocate, adaptive(1e-8));
  ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
  ASSERT_EQ(r.events.size(), 2u);
  EXPECT_NEAR(r.events[0].t, 0, 1e-12);
  EXPECT_NEAR(r.events[1].t, 0.2, 1e-12);
  EXPECT_NEAR(r.solution.state.x[0], 0.2, 1e-12);
}

TEST(Locate, SwitchAtTheEnd) {
  const Bounce problem;
  for (const double end : {1.0, std::nextafter(1.0, 2.0), std::nextafter(1.0, 0.0)}) {
    const Result r = run(problem, height(problem, 1), end, Discontinuity::kLocate, adaptive(1e-10));
    ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
    EXPECT_EQ(r.solution.state.t, end);
    EXPECT_NEAR(r.solution.state.u[0], 0, 1e-10);
    EXPECT_LE(r.events.size(), 1u);
  }
}

TEST(Locate, TwoSwitchesInOneStep) {
  const OnFor problem{0.5, 0.2};
  State<double> start(problem.sizes());
  IntegratorOptions options = adaptive(1e-8);
  options.step.h = 1;  // the whole interval is the first step
  const Result r = run(problem, start, 1, Discontinuity::kLocate, options);
  ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
  ASSERT_EQ(r.events.size(), 2u);
  EXPECT_NEAR(r.events[0].t, 0.5, 1e-12);
  EXPECT_NEAR(r.events[1].t, 0.7, 1e-12);
  EXPECT_NEAR(r.solution.state.x[0], 0.2, 1e-12);
}

TEST(SwitchingFunction, NotFiniteIsReported) {
  Bounce problem;
  problem.ground = std::numeric_limits<double>::quiet_NaN();
  for (const Discontinuity mode : {Discontinuity::kIgnore, Discontinuity::kIterate, Discontinuity::kLocate}) {
    const Result r = run(problem, height(problem, 1), 3, mode, adaptive(1e-6));
    EXPECT_EQ(r.solution.outcome, Outcome::kNotFinite) << idOf(mode);
    EXPECT_TRUE(contains(r.solution.detail, "'contact'"));
  }
}

}  // namespace
}  // namespace irk::test
