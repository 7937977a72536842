// Located events against exact solutions: which one comes first, and that what follows one is a new
// start.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/core/switching_run.h"

namespace irk::test {
namespace {

IntegratorOptions located(double tol) {
  IntegratorOptions o = adaptive(tol);
  o.step.estimate = ErrorEstimate::kRichardson;
  o.step.control = StepControl::kPredictive;
  o.newton.kind = NewtonKind::kSimplified;
  o.predictor = Predictor::kExtrapolated;
  o.jacobian_point = JacobianPoint::kStart;
  o.multipliers = Multipliers::kConsistent;
  return o;
}

/// Two clocks: switch i is due from t_i on. The rate is 1 before, 2 or 3 after the one that came
/// first, and 4 or 5 after both: the end tells which it was.
struct Clocks {
  double at[2];
  Sizes sizes() const {
    return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0, .discrete = 3, .switches = 2};
  }
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
  const std::pair<double, double> times[] = {{0.3, 0.7},   {0.51, 0.53},      {0.11, 0.112},
                                             {0.01, 0.99}, {0.4, 0.4 + 1e-6}, {0.9, 0.9001},
                                             {0.25, 0.26}};
  for (const auto& [low, high] : times) {
    for (const bool swapped : {false, true}) {
      const Clocks problem{{swapped ? high : low, swapped ? low : high}};
      for (const bool fixed : {false, true}) {
        IntegratorOptions options = fixed ? fixedSteps(1) : located(1e-8);
        options.step.h = 1;  // both lie in the first step
        const Result r =
            run(problem, State<double>(problem.sizes()), 1, Discontinuity::kLocate, options);
        ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << low << r.solution.detail;
        ASSERT_EQ(r.events.size(), 2u) << low << " " << high;
        EXPECT_EQ(r.events[0].index, swapped ? 1 : 0) << low << " " << high;
        EXPECT_EQ(r.events[1].index, swapped ? 0 : 1) << low << " " << high;
        // The resolution: 1e-5 of the tolerance, or of 1e-3 without one.
        EXPECT_NEAR(r.events[0].t, low, 1e-8) << low << " " << high;
        EXPECT_NEAR(r.events[1].t, high, 1e-8) << low << " " << high;
        EXPECT_NEAR(r.solution.state.x[0], problem.end(1), 1e-7) << low << " " << high;
      }
    }
  }
}

TEST(Events, BothAtTheSameTimeBothHappen) {
  const Clocks problem{{0.5, 0.5}};
  const Result r =
      run(problem, State<double>(problem.sizes()), 1, Discontinuity::kLocate, located(1e-8));
  ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
  ASSERT_EQ(r.events.size(), 2u);
  EXPECT_NEAR(r.solution.state.x[0], problem.end(1), 1e-8);
}

/// Due where sin(w t + phase) > 0, once: two upward crossings in the first step.
struct Wave {
  double w, phase;
  Sizes sizes() const {
    return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0, .discrete = 1, .switches = 1};
  }
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
    IntegratorOptions options = located(1e-8);
    options.step.h = 1;
    const Result r =
        run(problem, State<double>(problem.sizes()), 1, Discontinuity::kLocate, options);
    // Due at once where it starts above 0.
    const double at = std::sin(-4 * pi * first) > 0 ? 0 : first;
    ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
    ASSERT_EQ(r.events.size(), 1u) << first;
    EXPECT_NEAR(r.events[0].t, at, 1e-9);
    EXPECT_NEAR(r.solution.state.x[0], at + 2 * (1 - at), 1e-8);
  }
}

/// A point mass on a floor that returns half of the speed: a `jump` of v, twice differentiable
/// flight.
struct Ball {
  Sizes sizes() const {
    return {.nu = 1, .nx = 0, .nz = 0, .constraints = 0, .discrete = 1, .switches = 1};
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -2.0 - p.a[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = p.v[0] < T(0.0) ? T(-p.u[0]) : T(-1.0);
  }
  template <class T>
  void onSwitch(Index, const Point<T>& p, T* d) const {
    d[0] = p.d[0] + 1.0;  // counts
  }
  template <class T>
  void jump(Index, const Point<T>& p, T*, T* v, T*) const {
    v[0] = -0.5 * p.v[0];
  }
};

// From height 1 with g = 2: down at t = 1 with -2, up with 1, down at t = 2 with -1, up with 0.5.
TEST(Events, AJumpHappensAtItsEvent) {
  const Ball problem;
  State<double> start(problem.sizes());
  start.u[0] = 1;
  for (const char* method : {"radau_iia_3", "gauss_4", "lobatto_iiia_3"}) {
    const Result r = run(problem, start, 2.25, Discontinuity::kLocate, located(1e-8), method);
    ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << method << r.solution.detail;
    ASSERT_EQ(r.events.size(), 2u) << method;
    EXPECT_NEAR(r.events[0].t, 1, 1e-8) << method;
    EXPECT_NEAR(r.events[1].t, 2, 1e-8) << method;
    EXPECT_NEAR(r.solution.state.u[0], 0.25 * 0.5 - 0.25 * 0.25, 1e-7) << method;
    EXPECT_NEAR(r.solution.state.v[0], 0.5 - 2 * 0.25, 1e-7) << method;
    EXPECT_EQ(r.solution.state.d[0], 2) << method;
  }
}

/// x' = 1, from t = 0.55 on 5.
struct Kink {
  Sizes sizes() const {
    return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0, .discrete = 1, .switches = 1};
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = 1.0 + 4.0 * p.d[0] - p.k[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = p.d[0] > T(0.5) ? T(-1.0) : T(p.t - 0.55);
  }
  template <class T>
  void onSwitch(Index, const Point<T>&, T* d) const {
    d[0] = T(1.0);
  }
};

// Lobatto IIIA takes its first stage from the start: a rate of before the event would be an error
// of h b_1 4 = 0.03.
TEST(Events, WhatFollowsStartsWithConsistentRates) {
  const Kink problem;
  const Result r = run(problem, State<double>(problem.sizes()), 1, Discontinuity::kLocate,
                       fixedSteps(0.1), "lobatto_iiia_3");
  ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
  ASSERT_EQ(r.events.size(), 1u);
  EXPECT_NEAR(r.solution.state.x[0], 0.55 + 5 * 0.45, 1e-9);
}

// The rates are constant but for the event, so that start values are exact where nothing of before
// the event is extrapolated: each solve then takes one iteration.
TEST(Events, StartValuesAreNotTakenAcrossAnEvent) {
  const Kink problem;
  for (const auto predictor :
       {Predictor::kExtrapolated, Predictor::kPrevious, Predictor::kAcceleration}) {
    IntegratorOptions options = located(1e-6);
    options.predictor = predictor;
    options.step.h = 0.2;
    const Result r =
        run(problem, State<double>(problem.sizes()), 1, Discontinuity::kLocate, options);
    ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
    EXPECT_EQ(r.solution.counters.newton_iterations, r.solution.counters.solves);
    const auto attempts = r.solution.counters.newton_iterations / 3;  // of Richardson: h, h/2, h/2
    EXPECT_EQ(r.solution.counters.newton_iterations % 3, 0);
    // Without the event as many iterations per attempt.
    EXPECT_LE(attempts, r.solution.counters.steps_accepted + 6) << idOf(predictor);
    EXPECT_EQ(r.solution.counters.newton_restarts, 0);
  }
}

/// On for t in (0.5, 0.5 + width): due inside a step, at neither end.
struct Blink {
  double width;
  Sizes sizes() const {
    return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0, .discrete = 1, .switches = 2};
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = p.d[0] - p.k[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    const bool on = p.d[0] > T(0.5);
    g[0] = on ? T(-1.0) : T((p.t - 0.5) * (0.5 + width - p.t));
    g[1] = on ? T(p.t - 0.5 - width) : T(-1.0);
  }
  template <class T>
  void onSwitch(Index i, const Point<T>&, T* d) const {
    d[0] = T(i == 0 ? 1.0 : 0.0);
  }
};

// `iterate` looks at the modes at the ends of a step, and at its stages.
TEST(Iterate, SeesAModeThatComesAndGoes) {
  for (const double width : {0.2, 0.1}) {
    const Blink problem{width};
    IntegratorOptions options = located(1e-6);
    options.step.h = 1;
    const Result r =
        run(problem, State<double>(problem.sizes()), 1, Discontinuity::kIterate, options);
    ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
    EXPECT_NEAR(r.solution.state.x[0], width, 1e-4);
  }
}

// After a rejection with a switch in the step the next one ends at 0.98 of the way to it: what is
// left shrinks by 50 each time.
TEST(Iterate, ComesCloseToASwitchInFewSteps) {
  const Kink problem;
  IntegratorOptions options = located(1e-6);
  options.step.h = 1;
  const Result r =
      run(problem, State<double>(problem.sizes()), 1, Discontinuity::kIterate, options);
  ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
  EXPECT_LE(r.solution.counters.steps_rejected_error, 6);
  EXPECT_NEAR(r.solution.state.x[0], 0.55 + 5 * 0.45, 1e-4);
}

/// x' = -rate (x - 1), and a million times as fast from t = 0.5 on.
struct Stiffening {
  Sizes sizes() const {
    return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0, .discrete = 1, .switches = 1};
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    const double rate = p.d[0] > T(0.5) ? 1e6 : 1;
    r.x[0] = -rate * (p.x[0] - cos(p.t)) - p.k[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = p.d[0] > T(0.5) ? T(-1.0) : T(p.t - 0.5);
  }
  template <class T>
  void onSwitch(Index, const Point<T>&, T* d) const {
    d[0] = T(1.0);
  }
};

// With the Jacobian of the mode before Newton's increments grow by h 1e6: it would fail, and be
// started again with a new one.
TEST(Events, TheJacobianIsOfTheNewMode) {
  const Stiffening problem;
  for (const auto kind : {NewtonKind::kSimplified, NewtonKind::kBroyden, NewtonKind::kModified}) {
    for (const auto terms : {JacobianTerms::kFull, JacobianTerms::kConstantStiffness}) {
      IntegratorOptions options = located(1e-6);
      options.newton.kind = kind;
      options.jacobian = terms;
      State<double> start(problem.sizes());
      start.x[0] = 1;
      const Result r = run(problem, start, 1, Discontinuity::kLocate, options);
      ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << idOf(kind) << r.solution.detail;
      ASSERT_EQ(r.events.size(), 1u);
      EXPECT_EQ(r.solution.counters.newton_restarts, 0) << idOf(kind);
      EXPECT_EQ(r.solution.counters.steps_rejected_newton, 0) << idOf(kind);
      EXPECT_GE(r.solution.counters.jacobians, 2) << idOf(kind);
      EXPECT_NEAR(r.solution.state.x[0], std::cos(1.0), 1e-5) << idOf(kind);
    }
  }
}

struct Step {
  double t, h, error;
  int iterations;
};

/// A driven oscillator whose spring has another stiffness from t = 0.5 on.
struct Spring {
  double factor;
  Sizes sizes() const {
    return {.nu = 1, .nx = 0, .nz = 0, .constraints = 0, .discrete = 1, .switches = 1};
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sin;
    const double k = p.d[0] > T(0.5) ? 9 * factor : 9;
    r.u[0] = sin(3.0 * p.t) - k * sin(p.u[0]) - p.a[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = p.d[0] > T(0.5) ? T(-1.0) : T(p.t - 0.5);
  }
  template <class T>
  void onSwitch(Index, const Point<T>&, T* d) const {
    d[0] = T(1.0);
  }
};

struct SpringRun {
  std::vector<Step> steps;
  State<double> event;
  int attempts = 0, attempts_at_event = 0, attempts_of_first = 0;  // the first step after the event
};

SpringRun springRun(const Spring& problem, const State<double>& start,
                    const IntegratorOptions& options) {
  Integrator<double> integrator(
      makeSystem<double>(problem,
                         {Formulation::kIndex2, ConstraintScaling::kOn, Discontinuity::kLocate}),
      makeTableau<double>("radau_iia_3"), options);
  SpringRun run;
  Monitor<double> monitor;
  monitor.interrupt = [&] { return ++run.attempts, Outcome::kSuccess; };
  monitor.accepted = [&](const StepRecord<double>& s) {
    run.steps.push_back({s.t, s.h, s.error, s.newton_iterations});
    if (s.t > 0.5 + 1e-6 && run.attempts_of_first == 0) {
      run.attempts_of_first = run.attempts - run.attempts_at_event;
    }
  };
  monitor.switched = [&](const SwitchRecord<double>& s) {
    run.event = s.state;
    run.attempts_at_event = run.attempts;
  };
  const auto solution = integrator.integrate(start, 3.0, monitor);
  EXPECT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
  return run;
}

// After an event nothing of before it decides: not the polynomial, the Jacobian, Newton's
// contraction, nor the controller's memory of errors and steps. The same steps as of an integration
// that begins there.
TEST(Events, ARestartIsANewStart) {
  for (const auto control : {StepControl::kPredictive, StepControl::kPaper, StepControl::kHotint}) {
    for (const auto estimate : {ErrorEstimate::kRichardson, ErrorEstimate::kEmbedded}) {
      int compared = 0;
      for (const double factor : {0.4, 0.8, 1.05, 1.1, 1.15, 1.2, 1.3, 1.5}) {
        const Spring problem{factor};
        IntegratorOptions options = located(1e-7);
        options.step.control = control;
        options.step.estimate = estimate;
        State<double> start(problem.sizes());
        start.u[0] = 0.7;
        const SpringRun whole = springRun(problem, start, options);
        const auto after = std::find_if(whole.steps.begin(), whole.steps.end(),
                                        [](const Step& s) { return s.t > 0.5 + 1e-6; });
        ASSERT_NE(after, whole.steps.end());
        if (whole.attempts_of_first != 1) continue;  // rejected: the fresh run does not know of it
        ++compared;
        options.step.h = after->h;
        const SpringRun fresh = springRun(problem, whole.event, options);
        const std::vector<Step> rest(after, whole.steps.end());
        // Only that errors of many steps add up goes on: from the fiftieth on.
        const std::size_t common = std::min({fresh.steps.size(), rest.size(), std::size_t{20}});
        ASSERT_GE(common, std::min(rest.size(), std::size_t{20})) << idOf(control) << idOf(estimate);
        for (std::size_t i = 0; i < common; ++i) {
          EXPECT_NEAR(fresh.steps[i].h, rest[i].h, 1e-4 * rest[i].h)
              << idOf(control) << " " << idOf(estimate) << " " << factor << " step " << i;
          EXPECT_NEAR(fresh.steps[i].iterations, rest[i].iterations, 1)  // round-off at thresholds
              << idOf(control) << " " << idOf(estimate) << " " << factor << " step " << i;
        }
      }
      EXPECT_GE(compared, 3) << idOf(control) << " " << idOf(estimate);
    }
  }
}

// Also a step that ends at an event is recorded with its own size.
TEST(Events, StepsAddUp) {
  for (const bool fixed : {false, true}) {
    IntegratorOptions options = fixed ? fixedSteps(0.17) : located(1e-7);
    State<double> start(Spring{2}.sizes());
    start.u[0] = 0.7;
    const SpringRun run = springRun({2}, start, options);
    double t = 0;
    for (const Step& s : run.steps) {
      EXPECT_NEAR(s.h, s.t - t, 1e-13) << "at t = " << s.t;
      t = s.t;
    }
    EXPECT_EQ(t, 3);
  }
}

/// A nonlinear pendulum; due below a level, once.
struct Passing {
  double level;
  Sizes sizes() const {
    return {.nu = 1, .nx = 0, .nz = 0, .constraints = 0, .discrete = 1, .switches = 1};
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sin;
    r.u[0] = -4.0 * sin(p.u[0]) - p.a[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = p.d[0] > T(0.5) ? T(-1.0) : T(level - p.u[0]);
  }
  template <class T>
  void onSwitch(Index, const Point<T>&, T* d) const {
    d[0] = T(1.0);
  }
};

// Re-solving a step to its switch takes about four attempts with two factorizations each; a wrong
// slope, or a guess in the wrong half of the step, takes half as many again and more. The first step after
// the restart has to follow (a, k) at its start: one attempt more.
TEST(Events, AreFoundInFewAttempts) {
  std::int64_t more = 0, events = 0;
  for (const double tol : {1e-4, 1e-8}) {
    for (const double level : {0.9, 0.7, 0.4, 0.1, -0.3}) {
      for (const char* method : {"radau_iia_2", "radau_iia_5"}) {
        const auto factorizations = [&](double at) {
          const Passing problem{at};
          State<double> start(problem.sizes());
          start.u[0] = 1;
          IntegratorOptions options = located(tol);
          options.step.h = 0.3;
          const Result r = run(problem, start, 1.2, Discontinuity::kLocate, options, method);
          EXPECT_EQ(r.solution.outcome, Outcome::kSuccess);
          events += static_cast<std::int64_t>(r.events.size());
          return r.solution.counters.factorizations;
        };
        more += factorizations(level) - factorizations(-9);
      }
    }
  }
  EXPECT_EQ(events, 20);
  EXPECT_LE(more, 14 * events);
}

/// x' = x, from 1; due where x reaches `level`, and where t reaches `at`. The steps' dense output
/// is of low order: which of the two comes first only solved steps tell.
struct Race {
  double level, at;
  bool swapped;
  Sizes sizes() const {
    return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0, .discrete = 2, .switches = 2};
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = p.x[0] - p.k[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    using std::exp;
    g[swapped ? 1 : 0] = p.d[swapped ? 1 : 0] > T(0.5) ? T(-1.0) : T(p.x[0] - level);
    g[swapped ? 0 : 1] = p.d[swapped ? 0 : 1] > T(0.5) ? T(-1.0) : T(exp(p.t) - exp(at));
  }
  template <class T>
  void onSwitch(Index i, const Point<T>&, T* d) const {
    d[i] = T(1.0);
  }
};

TEST(Events, OfARaceAreOrderedBySolvedSteps) {
  for (const double tol : {1e-3, 1e-5, 1e-8}) {
    for (const double lag : {0.03, 0.003, 0.0003, -0.0003, -0.003, -0.03}) {
      for (const double crossing : {0.4, 0.7, 1.1}) {
        for (const bool swapped : {false, true}) {
          const Race problem{std::exp(crossing), crossing + lag, swapped};
          State<double> start(problem.sizes());
          start.x[0] = 1;
          IntegratorOptions options = located(tol);
          options.step.h = 1.5;
          for (const char* method : {"radau_iia_2", "radau_iia_3"}) {
            const Result r = run(problem, start, 1.5, Discontinuity::kLocate, options, method);
            ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
            ASSERT_EQ(r.events.size(), 2u);
            // That of the clock is known to round-off, however inexact the steps are.
            const auto clock =
                static_cast<std::size_t>(r.events[0].index == (swapped ? 0 : 1) ? 0 : 1);
            EXPECT_NEAR(r.events[clock].t, problem.at, 1e-7)
                << tol << " " << lag << " " << crossing;
            if (std::abs(lag) < 200 * tol) continue;
            const bool by_level = (lag > 0) != swapped;
            EXPECT_EQ(r.events[0].index, by_level ? 0 : 1) << tol << " " << lag << " " << crossing;
            EXPECT_NEAR(r.events[0].t, std::min(crossing, crossing + lag), 100 * tol);
            EXPECT_NEAR(r.events[1].t, std::max(crossing, crossing + lag), 100 * tol);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace irk::test
