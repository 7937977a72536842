// What steps do at switches and known times beyond locating them: each test fails if one line of it is missing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/core/switching_run.h"

namespace irk::test {
namespace {

/// A pendulum of length 1 in Cartesian coordinates. At t = 0.42 it becomes twice as heavy; the tension z that follows
/// from that makes the second switch due, at the same time.
struct HeavierPendulum : OnUnitCircle {
  Sizes sizes() const { return {.nu = 2, .nx = 0, .nz = 1, .constraints = 1, .discrete = 2, .switches = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -p.a[0] - p.u[0] * p.z[0];
    r.u[1] = -p.a[1] - 10.0 * (1.0 + p.d[0]) - p.u[1] * p.z[0];
  }
  // Falling from rest at height 0, v^2 = -20 u_1 and z = v^2 - 10 (1 + d) u_1 = -(30 + 10 d) u_1.
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = p.d[0] > T(0.5) ? T(-1.0) : T(p.t - 0.42);
    g[1] = p.d[0] > T(0.5) && p.d[1] < T(0.5) ? T(p.z[0] + 35.0 * p.u[1]) : T(-1.0);
  }
  template <class T>
  void onSwitch(Index i, const Point<T>&, T* d) const {
    d[i] = T(1.0);
  }
};

// In index 3 velocities satisfy their constraint to the error of a step only. A restart projects them: the second
// switch sees the state after that.
TEST(Events, Index3RestartsWithVelocitiesOnTheirConstraint) {
  IntegratorOptions options = fixedSteps(0.05);
  const auto system = makeSystem<double>(HeavierPendulum{}, {Formulation::kIndex3});
  Integrator<double> integrator(system, makeTableau<double>("radau_iia_3"), options);
  const auto start = startOf(HeavierPendulum{}, {.u = {1, 0}});
  std::vector<double> normal_speed, length;
  std::vector<Index> order;
  Monitor<double> monitor;
  monitor.switched = [&](const SwitchRecord<double>& s) {
    order.push_back(s.index);
    normal_speed.push_back(std::abs(s.state.u.dot(s.state.v)));
    length.push_back(s.state.u.norm());
  };
  const auto solution = integrator.integrate(start, 0.5, monitor);
  ASSERT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
  ASSERT_EQ(order, (std::vector<Index>{0, 1}));
  EXPECT_GT(normal_speed[0], 1e-6) << "the test can fail";
  EXPECT_LT(normal_speed[1], 1e-13);
  EXPECT_NEAR(length[1], 1, 1e-14);
}

/// Nothing happens at the declared time.
struct Interrupted : Decay {
  std::vector<double> times() const { return {0.601}; }
};

// Steps of 0.3 and two halves of 0.301, which say nothing about the size that the motion allows.
TEST(Steps, ThatAKnownTimeCutsShortDoNotShortenTheNext) {
  for (const auto control : {StepControl::kPredictive, StepControl::kPaper, StepControl::kHotint}) {
    IntegratorOptions options = adaptive(1e-4);
    options.step.control = control;
    options.step.h = options.step.h_max = 0.3;
    std::vector<double> sizes;
    Monitor<double> monitor;
    monitor.accepted = [&](const StepRecord<double>& s) { sizes.push_back(s.h); };
    Integrator<double> integrator(makeSystem<double>(Interrupted{}), makeTableau<double>("radau_iia_5"), options);
    ASSERT_EQ(integrator.integrate(decayStart(), 2, monitor).outcome, Outcome::kSuccess) << idOf(control);
    ASSERT_GE(sizes.size(), 4u);
    EXPECT_NEAR(sizes[1], 0.1505, 1e-12) << idOf(control);
    EXPECT_NEAR(sizes[2], 0.1505, 1e-12) << idOf(control);
    EXPECT_NEAR(sizes[3], 0.3, 1e-12) << idOf(control);
  }
}

/// x = (sin 4t, cos 4t). Switch 0 is due at t = 0.7, switch 1 while sin 4t > 0.65, for the first time at t = 0.177.
struct HiddenPeak {
  Sizes sizes() const { return {.nu = 0, .nx = 2, .nz = 0, .constraints = 0, .discrete = 2, .switches = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = 4.0 * p.x[1] - p.k[0];
    r.x[1] = -4.0 * p.x[0] - p.k[1];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    using std::exp;
    g[0] = p.d[0] > T(0.5) ? T(-1.0) : T(exp(p.t) - exp(0.7));
    g[1] = p.d[1] > T(0.5) ? T(-1.0) : T(p.x[0] - 0.65);
  }
  template <class T>
  void onSwitch(Index i, const Point<T>&, T* d) const {
    d[i] = T(1.0);
  }
};

// The polynomial of one step of 1 (Radau IIA with two stages) rises to 0.562 only, that of the step shortened to 0.7 to
// 0.756, and ends at 0.442: neither end shows the switch. (Both from y' = 4i y, by hand.)
TEST(Events, AnEarlierOneThatOnlyTheShortenedStepShowsComesFirst) {
  const auto start = startOf(HiddenPeak{}, {.x = {0, 1}});
  const Result r = run(HiddenPeak{}, start, 1, Discontinuity::kLocate, fixedSteps(1), "radau_iia_2");
  ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
  ASSERT_EQ(r.events.size(), 2u);
  EXPECT_EQ(r.events[0].index, 1);
  EXPECT_NEAR(r.events[0].t, std::asin(0.65) / 4, 0.01) << "one step's error";
  EXPECT_EQ(r.events[1].index, 0);
  EXPECT_NEAR(r.events[1].t, 0.7, 1e-12);
}

TEST(Ignore, SeesAModeThatComesAndGoesInsideAStep) {
  // Between the stages 0.155 and 0.645 of a step of 1 with Radau IIA, and between 0.322 and 0.5 of its halves.
  const OnFor problem{0.34, 0.14};
  for (IntegratorOptions options : {adaptive(1e-6), embedded(1e-6)}) {
    options.step.h = 1;
    const Result r = run(problem, State<double>(problem.sizes()), 1, Discontinuity::kIgnore, options, "radau_iia_3");
    const auto estimate = idOf(options.step.estimate);
    ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << estimate << ": " << r.solution.detail;
    EXPECT_NEAR(r.solution.state.x[0], 0.14, 1e-4) << estimate << ", a step over it: 0";
  }
}

/// x = t. The switch is due one unit of round-off before t = 1, so that it is due at t = 1 by round-off alone.
struct DueByRoundOff {
  Sizes sizes() const { return {.nx = 1, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = T(1.0) - p.k[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = p.d[0] > T(0.5) ? T(-1.0) : T(p.x[0] - std::nextafter(1.0, 0.0));
  }
  template <class T>
  void onSwitch(Index, const Point<T>&, T* d) const {
    d[0] = T(1.0);
  }
};

// A switch that was executed at a time is due there again by more than its round-off only. What an integration before
// has executed says nothing.
TEST(Steps, ForgetSwitchesOfTheIntegrationBefore) {
  for (const auto mode : {Discontinuity::kIgnore, Discontinuity::kIterate}) {
    Integrator<double> integrator(
        makeSystem<double>(DueByRoundOff{}, {Formulation::kIndex2, ConstraintScaling::kOn, mode}),
        makeTableau<double>("gauss_2"), fixedSteps(0.25));
    for (int i = 0; i < 3; ++i) {
      const auto solution = integrator.integrate(State<double>(DueByRoundOff{}.sizes()), 1);
      ASSERT_EQ(solution.outcome, Outcome::kSuccess) << idOf(mode) << solution.detail;
      EXPECT_EQ(solution.state.d[0], 1) << idOf(mode) << ", integration " << i;
    }
  }
}

}  // namespace
}  // namespace irk::test
