// Located events against exact solutions: the order of events, and a consistent restart after each.
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "irk/scene.h"
#include "tests/core/switching_run.h"

namespace irk::test {
namespace {

/// Two clocks: switch i is due from t_i on. The rate is 1 at first, 2 or 3 after the first event (depending on which
/// it is), and 4 or 5 after both, so the result shows which event came first.
struct Clocks {
  double at[2];
  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0, .discrete = 3, .switches = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const bool one = p.d[0] > T(0.5), two = p.d[1] > T(0.5), first = p.d[2] < T(0.5);
    const double rate = one && two ? (first ? 4 : 5) : one ? 2 : two ? 3 : 1;
    r.x[0] = rate - p.k[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    using std::exp;  // no root is met exactly
    for (int i = 0; i < 2; ++i) g[i] = p.d[i] > T(0.5) ? T(-1.0) : T(exp(p.t) - exp(at[i]));
  }
  template <class T>
  void onSwitch(Index i, const Point<T>& p, T* d) const {
    if (p.d[0] < T(0.5) && p.d[1] < T(0.5)) d[2] = T(static_cast<double>(i));
    d[i] = T(1.0);
  }
  double end(double t) const {
    const double low = std::min(at[0], at[1]), high = std::max(at[0], at[1]);
    const bool first = at[0] <= at[1];
    return low + (first ? 2 : 3) * (high - low) + (first ? 4 : 5) * (t - high);
  }
};

TEST(Events, TheEarlierOfTwoInOneStepComesFirst) {
  const std::pair<double, double> times[] = {{0.3, 0.7},    {0.51, 0.53},      {0.11, 0.112}, {0.01, 0.99},
                                             {0.5, 0.5001}, {0.4, 0.4 + 1e-6}, {0.9, 0.9001}, {0.25, 0.26}};
  for (const auto& [low, high] : times) {
    for (const bool swapped : {false, true}) {
      const Clocks problem{{swapped ? high : low, swapped ? low : high}};
      for (IntegratorOptions options : {fixedSteps(1), adaptive(1e-9), embedded(1e-9)}) {
        options.step.h = 1;  // both lie in the first step
        const Result r = run(problem, State<double>(problem.sizes()), 1, Discontinuity::kLocate, options);
        ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << low << r.solution.detail;
        ASSERT_EQ(r.events.size(), 2u) << low << " " << high;
        EXPECT_EQ(r.events[0].index, swapped ? 1 : 0) << low << " " << high;
        EXPECT_EQ(r.events[1].index, swapped ? 0 : 1) << low << " " << high;
        // The resolution of the location: 1e-5 of the tolerance, or of 1e-3 if there is none.
        const double resolution = options.step.control == StepControl::kFixed ? 1e-8 : 1e-11;
        EXPECT_NEAR(r.events[0].t, low, resolution) << low << " " << high;
        EXPECT_NEAR(r.events[1].t, high, resolution) << low << " " << high;
        EXPECT_NEAR(r.solution.state.x[0], problem.end(1), 10 * resolution) << low << " " << high;
      }
    }
  }
}

TEST(Events, BothAtTheSameTimeBothHappen) {
  const Clocks problem{{0.5, 0.5}};
  for (const auto& options : {adaptive(1e-8), embedded(1e-8)}) {
    const Result r = run(problem, State<double>(problem.sizes()), 1, Discontinuity::kLocate, options);
    ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
    ASSERT_EQ(r.events.size(), 2u);
    EXPECT_NEAR(r.solution.state.x[0], problem.end(1), 1e-8);
  }
}

/// Due once, when sin(w t + phase) > 0; the first step contains two upward crossings.
struct Wave {
  double w, phase;
  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = 1.0 + p.d[0] - p.k[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    using std::sin;
    g[0] = p.d[0] > T(0.5) ? T(-1.0) : T(sin(w * p.t + phase));
  }
  template <class T>
  void onSwitch(Index, const Point<T>&, T* d) const {
    d[0] = T(1.0);
  }
};

TEST(Events, TheFirstOfTwoCrossingsOfOneFunction) {
  const double pi = std::acos(-1.0);
  for (const double first : {0.05, 0.13, 0.21, 0.33}) {
    const Wave problem{4 * pi, -4 * pi * first};  // up at `first` and at first + 0.5
    IntegratorOptions options = adaptive(1e-8);
    options.step.h = 1;
    const Result r = run(problem, State<double>(problem.sizes()), 1, Discontinuity::kLocate, options);
    // Due at once if it starts above 0.
    const double at = std::sin(-4 * pi * first) > 0 ? 0 : first;
    ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
    ASSERT_EQ(r.events.size(), 1u) << first;
    EXPECT_NEAR(r.events[0].t, at, 1e-9);
    EXPECT_NEAR(r.solution.state.x[0], at + 2 * (1 - at), 1e-8);
  }
}

// From height 1 with g = 2: down at t = 1 with -2, up with 1, down at t = 2 with -1, up with 0.5.
TEST(Events, AJumpHappensAtItsEvent) {
  const BouncingBall problem{2, 0.5};
  for (const char* method : {"radau_iia_3", "gauss_4", "lobatto_iiia_3"}) {
    const Result r = run(problem, problem.start(), 2.25, Discontinuity::kLocate, adaptive(1e-8), method);
    ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << method << r.solution.detail;
    ASSERT_EQ(r.events.size(), 2u) << method;
    EXPECT_NEAR(r.events[0].t, 1, 1e-8) << method;
    EXPECT_NEAR(r.events[1].t, 2, 1e-8) << method;
    EXPECT_NEAR(r.solution.state.u[0], 0.25 * 0.5 - 0.25 * 0.25, 1e-7) << method;
    EXPECT_NEAR(r.solution.state.v[0], 0.5 - 2 * 0.25, 1e-7) << method;
    EXPECT_EQ(r.solution.state.d[0], 2) << method;
  }
}

/// x' = 1, and 5 from t = 0.55 on.
struct Kink : SwitchesOnceAt {
  Kink() : SwitchesOnceAt(0.55) {}
  Sizes sizes() const { return {.nx = 1, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = 1.0 + 4.0 * p.d[0] - p.k[0];
  }
};

// The first stage of Lobatto IIIA is the start of the step: a rate from before the event would cause an error of h
// b_1 4 = 0.03.
TEST(Events, WhatFollowsStartsWithConsistentRates) {
  const Kink problem;
  const Result r =
      run(problem, State<double>(problem.sizes()), 1, Discontinuity::kLocate, fixedSteps(0.1), "lobatto_iiia_3");
  ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
  ASSERT_EQ(r.events.size(), 1u);
  EXPECT_NEAR(r.solution.state.x[0], 0.55 + 5 * 0.45, 1e-9);
}

// The rates are constant except at the event. Start values are therefore exact, and each solve takes one iteration,
// unless values from before the event are extrapolated.
TEST(Events, StartValuesAreNotTakenAcrossAnEvent) {
  const Kink problem;
  for (const auto predictor : {Predictor::kExtrapolated, Predictor::kPrevious, Predictor::kAcceleration}) {
    IntegratorOptions options = adaptive(1e-6);
    options.predictor = predictor;
    options.step.h = 0.2;
    const Result r = run(problem, State<double>(problem.sizes()), 1, Discontinuity::kLocate, options);
    ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
    const auto attempts = r.solution.counters.newton_iterations / 3;  // of Richardson: h, h/2, h/2
    EXPECT_EQ(r.solution.counters.newton_iterations % 3, 0);
    // Without the event every attempt needs the same number of iterations.
    EXPECT_LE(attempts, r.solution.counters.steps_accepted + 6) << idOf(predictor);
    EXPECT_EQ(r.solution.counters.newton_restarts, 0);
  }
}

// `iterate` checks the modes at the ends of a step and at its stages.
TEST(Iterate, SeesAModeThatComesAndGoes) {
  for (const double width : {0.2, 0.1}) {
    const OnFor problem{0.5, width};
    IntegratorOptions options = adaptive(1e-6);
    options.step.h = 1;
    const Result r = run(problem, State<double>(problem.sizes()), 1, Discontinuity::kIterate, options);
    ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
    EXPECT_NEAR(r.solution.state.x[0], width, 1e-4);
  }
}

// After a rejection because of a switch the next step ends at 0.9 of the way to it: the remaining distance shrinks by
// 10 each time.
TEST(Iterate, ComesCloseToASwitchInFewSteps) {
  const Kink problem;
  IntegratorOptions options = adaptive(1e-6);
  options.step.h = 1;
  const Result r = run(problem, State<double>(problem.sizes()), 1, Discontinuity::kIterate, options);
  ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
  EXPECT_LE(r.solution.counters.steps_rejected_error, 8);
  EXPECT_NEAR(r.solution.state.x[0], 0.55 + 5 * 0.45, 1e-4);
}

// The root of the dense output may lie a little before that of the solved step. A step that ended there would leave a
// tiny one.
TEST(Events, NoStepEndsJustBeforeASwitch) {
  const auto scene = makeScene<double>("mechatronic_crank");
  for (const double tol : {1e-2, 1e-3, 1e-4, 1e-5}) {
    Integrator<double> integrator(scene.system({}), makeTableau<double>("radau_iia_3"), embedded(tol), scene.scale);
    Monitor<double> monitor;
    double last = 0, least = 1;
    monitor.accepted = [&](const StepRecord<double>& step) {
      if (last > 0) least = std::min(least, step.h / last);
      last = step.h;
    };
    const auto s = integrator.integrate(scene.start, scene.t_end, monitor);
    ASSERT_EQ(s.outcome, Outcome::kSuccess) << s.detail;
    EXPECT_GT(s.counters.located_events, 10);
    EXPECT_GT(least, 1e-3) << tol;
  }
}

}  // namespace
}  // namespace irk::test
