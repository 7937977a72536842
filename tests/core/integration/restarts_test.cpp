#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/core/switching_run.h"

namespace irk::test {
namespace {

/// x' = -rate (x - 1), with a rate a million times larger from t = 0.5 on.
struct Stiffening : SwitchesOnceAt {
  Stiffening() : SwitchesOnceAt(0.5) {}
  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    const double rate = p.d[0] > T(0.5) ? 1e6 : 1;
    r.x[0] = -rate * (p.x[0] - cos(p.t)) - p.k[0];
  }
};

// With the Jacobian of the previous mode Newton's increments would grow by h 1e6; it would fail and start again with
// a new Jacobian.
TEST(Events, TheJacobianIsOfTheNewMode) {
  const Stiffening problem;
  for (const auto kind : {NewtonKind::kSimplified, NewtonKind::kBroyden, NewtonKind::kModified}) {
    for (const auto terms : {JacobianTerms::kFull, JacobianTerms::kConstantStiffness}) {
      IntegratorOptions options = adaptive(1e-6);
      options.newton.kind = kind;
      options.jacobian = terms;
      const Result r = run(problem, startOf(problem, {.x = {1}}), 1, Discontinuity::kLocate, options);
      ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << idOf(kind) << r.solution.detail;
      ASSERT_EQ(r.events.size(), 1u);
      EXPECT_EQ(r.solution.counters.newton_restarts, 0) << idOf(kind);
      EXPECT_EQ(r.solution.counters.steps_rejected_newton, 0) << idOf(kind);
      EXPECT_GE(r.solution.counters.jacobians, 4) << "start, step, restart, step: " << idOf(kind);
      EXPECT_NEAR(r.solution.state.x[0], std::cos(1.0), 1e-5) << idOf(kind);
    }
  }
}

struct Step {
  double t, h, error;
  int iterations;
};

/// A driven oscillator whose spring stiffness changes at t = 0.5.
struct Spring : SwitchesOnceAt {
  double factor;
  explicit Spring(double f) : SwitchesOnceAt(0.5), factor(f) {}
  Sizes sizes() const { return {.nu = 1, .nx = 0, .nz = 0, .constraints = 0, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sin;
    const double k = p.d[0] > T(0.5) ? 9 * factor : 9;
    r.u[0] = sin(3.0 * p.t) - k * sin(p.u[0]) - p.a[0];
  }
};

struct SpringRun {
  std::vector<Step> steps;
  State<double> event;
  int attempts = 0, attempts_at_event = 0, attempts_of_first = 0;  // the first step after the event
};

SpringRun springRun(const Spring& problem, const State<double>& start, const IntegratorOptions& options) {
  Integrator<double> integrator(makeSystem<double>(problem), makeTableau<double>("radau_iia_3"), options);
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

// After an event nothing from before it may be used: neither the polynomial, the Jacobian, Newton's contraction nor
// the controller's history of errors and steps. The steps must equal those of an integration that begins at the
// event.
TEST(Events, ARestartIsANewStart) {
  for (const auto control : {StepControl::kPredictive, StepControl::kPaper, StepControl::kHotint}) {
    for (const auto estimate : {ErrorEstimate::kRichardson, ErrorEstimate::kEmbedded}) {
      int compared = 0;
      for (const double factor : {0.4, 0.8, 1.05, 1.1, 1.15, 1.2, 1.3, 1.5}) {
        const Spring problem{factor};
        IntegratorOptions options = adaptive(1e-7);
        options.step.control = control;
        options.step.estimate = estimate;
        const SpringRun whole = springRun(problem, startOf(problem, {.u = {0.7}}), options);
        const auto after =
            std::find_if(whole.steps.begin(), whole.steps.end(), [](const Step& s) { return s.t > 0.5 + 1e-6; });
        ASSERT_NE(after, whole.steps.end());
        if (whole.attempts_of_first != 1) continue;  // rejected: the fresh run cannot know this
        ++compared;
        options.step.h = after->h;
        const SpringRun fresh = springRun(problem, whole.event, options);
        const std::vector<Step> rest(after, whole.steps.end());
        // Only the sum of errors over many steps continues; it has an effect from the fiftieth step on.
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

// A step that ends at an event is recorded with its own size, too.
TEST(Events, StepsAddUp) {
  for (const bool fixed : {false, true}) {
    IntegratorOptions options = fixed ? fixedSteps(0.17) : adaptive(1e-7);
    const SpringRun run = springRun(Spring{2}, startOf(Spring{2}, {.u = {0.7}}), options);
    double t = 0;
    for (const Step& s : run.steps) {
      EXPECT_NEAR(s.h, s.t - t, 1e-13) << "at t = " << s.t;
      t = s.t;
    }
    EXPECT_EQ(t, 3);
  }
}

/// A nonlinear pendulum; its switch is due once, below a level.
struct Passing {
  double level;
  Sizes sizes() const { return {.nu = 1, .nx = 0, .nz = 0, .constraints = 0, .discrete = 1, .switches = 1}; }
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

// Solving a step again up to its switch takes about four attempts with two factorizations each. A wrong slope, or a
// guess in the wrong half of the step, would take at least half as many again. The first step after the restart takes
// one more attempt, because (a, k) at its start change.
TEST(Events, AreFoundInFewAttempts) {
  std::int64_t more = 0, events = 0;
  for (const double tol : {1e-4, 1e-8}) {
    for (const double level : {0.9, 0.7, 0.4, 0.1, -0.3}) {
      for (const char* method : {"radau_iia_2", "radau_iia_5"}) {
        const auto factorizations = [&](double at) {
          const Passing problem{at};
          const auto start = startOf(problem, {.u = {1}});
          IntegratorOptions options = adaptive(tol);
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

/// x' = x, x(0) = 1; one switch is due at x = `level`, the other at t = `at`. The dense output has low order, so only
/// solved steps show which one comes first.
struct Race {
  double level, at;
  bool swapped;
  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0, .discrete = 2, .switches = 2}; }
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
          const auto start = startOf(problem, {.x = {1}});
          IntegratorOptions options = adaptive(tol);
          options.step.h = 1.5;
          for (const char* method : {"radau_iia_2", "radau_iia_3"}) {
            const Result r = run(problem, start, 1.5, Discontinuity::kLocate, options, method);
            ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
            ASSERT_EQ(r.events.size(), 2u);
            // The switch of the clock is located to round-off, regardless of the error of the steps.
            const auto clock = static_cast<std::size_t>(r.events[0].index == (swapped ? 0 : 1) ? 0 : 1);
            EXPECT_NEAR(r.events[clock].t, problem.at, 1e-7) << tol << " " << lag << " " << crossing;
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

/// A tank that runs empty, x' = -sqrt x, and is closed at x = least. A step beyond it has no residual.
struct Tank {
  static constexpr double kLeast = 1e-9;
  Sizes sizes() const { return {.nx = 1, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sqrt;
    r.x[0] = (p.d[0] > T(0.5) ? T(0) : T(-sqrt(p.x[0]))) - p.k[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = p.d[0] > T(0.5) ? T(-1) : T(kLeast - p.x[0]);
  }
  template <class T>
  void onSwitch(Index, const Point<T>&, T* d) const {
    d[0] = T(1);
  }
};

// The search for the switch solves steps that end where the residual is not finite. A shorter step is taken then.
TEST(Events, AStepOfTheSearchThatIsNotFiniteShortensTheStep) {
  for (const double tol : {1e-2, 1e-3, 1e-4, 1e-6}) {
    for (const auto& options : {adaptive(tol), embedded(tol)}) {
      for (const char* method : {"radau_iia_2", "radau_iia_3", "radau_iia_5", "lobatto_iiic_3"}) {
        const Result r = run(Tank{}, startOf(Tank{}, {.x = {1}}), 3, Discontinuity::kLocate, options, method);
        ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << method << ' ' << tol << ": " << r.solution.detail;
        EXPECT_NEAR(r.solution.state.x[0], Tank::kLeast, 10 * tol) << method;
        ASSERT_EQ(r.events.size(), 1u) << method;
      }
    }
  }
}

}  // namespace
}  // namespace irk::test
