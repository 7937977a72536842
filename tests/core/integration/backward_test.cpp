// Integration backward in time: t_end lies before the start.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/core/error_bar_run.h"
#include "tests/refusal.h"

namespace irk::test {
namespace {

/// A pendulum whose length changes, g = u^2 - l(t)^2, with friction: neither autonomous nor the same in both
/// directions.
struct DrivenPendulum {
  Sizes sizes() const { return {.nu = 2, .nx = 1, .nz = 1, .constraints = 1}; }
  template <class T>
  static T length(const T& t) {
    using std::sin;
    return 1.0 + 0.2 * sin(t);
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -p.a[0] - 0.3 * p.v[0] - p.u[0] * p.z[0];
    r.u[1] = -p.a[1] - 0.3 * p.v[1] - 9.81 - p.u[1] * p.z[0] + p.x[0];
    r.x[0] = p.v[0] - 0.5 * p.x[0] - p.k[0];
  }
  template <class T, class U, class G>
  void constraints(const T& t, const U& u, G&& g) const {
    const T l = length(t);
    g[0] = (u[0] * u[0] + u[1] * u[1] - l * l) * 0.5;
  }
  // u v = l l' = 0.2 at t = 0.
  State<double> start() const { return startOf(sizes(), {.u = {1, 0}, .v = {0.2, 0.7}, .x = {0.4}}); }
};

// Radau IIA with 3 stages, order 5. On the way from t = 2 to t = 1 the flow magnifies errors by e^5.
TEST(Backward, HasTheOrderOfTheMethod) {
  const auto phi = [](double t) { return 1.5 + std::sin(t); };
  const auto start = startOf(Riccati{}, {.t = 2, .x = {phi(2)}});
  const auto errorOf = [&](double h) {
    const auto solution = integrate<double>(Riccati{}, start, 1, makeTableau<double>("radau_iia_3"), fixedSteps(h));
    EXPECT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
    EXPECT_EQ(solution.state.t, 1);
    const double error = std::abs(solution.state.x[0] - phi(1));
    EXPECT_GT(error, 1e-12);
    return error;
  };
  EXPECT_NEAR(orderOf({1.0 / 32, 1.0 / 64, 1.0 / 128}, errorOf), 5, 0.2);
}

// There and back again. The tolerance is 1e-10; friction magnifies errors backward by e^0.6.
TEST(Backward, ReturnsToTheStartInEveryFormulation) {
  const State<double> start = DrivenPendulum{}.start();
  for (const auto formulation :
       {Formulation::kIndex1, Formulation::kIndex2, Formulation::kIndex2Projected, Formulation::kIndex3,
        Formulation::kGgl, Formulation::kFirstOrder, Formulation::kFirstOrderPerStep}) {
    SCOPED_TRACE(idOf(formulation));
    Integrator<double> integrator(makeSystem<double>(DrivenPendulum{}, {formulation}),
                                  makeTableau<double>("radau_iia_5"), adaptive(1e-10));
    const auto there = integrator.integrate(start, 1.5);
    ASSERT_EQ(there.outcome, Outcome::kSuccess) << there.detail;
    const auto back = integrator.integrate(there.state, 0);
    ASSERT_EQ(back.outcome, Outcome::kSuccess) << back.detail;
    EXPECT_EQ(back.state.t, 0);
    EXPECT_LT((back.state.u - start.u).norm(), 1e-7);
    EXPECT_LT((back.state.v - start.v).norm(), 1e-7);
    EXPECT_LT((back.state.x - start.x).norm(), 1e-7);
    const auto again = integrator.integrate(back.state, 1.5);
    EXPECT_LT((again.state.w - there.state.w).norm(), 1e-5) << "a, k, z";
    EXPECT_EQ(integrator.integrate(start, 1.5).state.u, there.state.u) << "the way back leaves a trace";
  }
}

// Without friction, and from rest, the motion backward is the motion forward, with opposite velocities.
TEST(Backward, IsTheMirrorOfAMotionFromRest) {
  for (const auto formulation : {Formulation::kIndex2, Formulation::kGgl, Formulation::kFirstOrder}) {
    const auto run = [&](double t_end) {
      return integrate<double>(CartesianPendulum{}, pendulumStart<double>(), t_end, makeTableau<double>("radau_iia_5"),
                               adaptive(1e-9), formulation);
    };
    const auto forward = run(1), backward = run(-1);
    ASSERT_EQ(backward.outcome, Outcome::kSuccess) << backward.detail;
    EXPECT_EQ(backward.state.t, -1);
    EXPECT_LT((backward.state.u - forward.state.u).norm(), 1e-12);
    EXPECT_LT((backward.state.v + forward.state.v).norm(), 1e-12);
    EXPECT_LT((backward.state.w - forward.state.w).norm(), 1e-10);
    const double energy = backward.state.v.squaredNorm() / 2 + 9.81 * backward.state.u[1];
    EXPECT_NEAR(energy, 0, 1e-7);
    EXPECT_EQ(backward.counters.steps_accepted, forward.counters.steps_accepted);
  }
}

/// x' = |t - 1|, with the kink declared or not; x = (t - 1) |t - 1| / 2.
struct BentRate {
  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = (p.t < T(1.0) ? 1.0 - p.t : p.t - 1.0) - p.k[0];
  }
  std::vector<double> times() const { return {-5, 0.5, 1}; }
};

TEST(Backward, TellsTheCallersTimes) {
  const auto start = startOf(BentRate{}, {.t = 3, .x = {2}});
  std::vector<double> ends;
  Monitor<double> monitor;
  monitor.inside = true;
  double before = start.t;
  monitor.accepted = [&](const StepRecord<double>& step) {
    ends.push_back(step.t);
    EXPECT_NEAR(step.t - step.h, before, 1e-14);
    EXPECT_EQ(step.state.t, step.t);
    EXPECT_NEAR(step.state.k()[0], std::abs(step.t - 1), 1e-12);
    const double t = (before + step.t) / 2;
    const State<double> middle = step.inside->at(t);
    EXPECT_EQ(middle.t, t);
    EXPECT_NEAR(middle.x[0], (t - 1) * std::abs(t - 1) / 2, 1e-13);
    before = step.t;
  };
  Integrator<double> integrator(makeSystem<double>(BentRate{}), makeTableau<double>("radau_iia_5"), fixedSteps(0.75));
  const auto solution = integrator.integrate(start, 0, monitor);
  ASSERT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
  EXPECT_NEAR(solution.state.x[0], -0.5, 1e-13);
  const std::vector<double> wanted{2.25, 1.5, 1, 0.75, 0.5, 0};
  EXPECT_EQ(ends, wanted);
}

TEST(Backward, FailuresNameTheCallersTime) {
  IntegratorOptions options = adaptive(1e-10);
  options.step.max_steps = 3;
  State<double> start = DrivenPendulum{}.start();
  const auto failed = integrate<double>(DrivenPendulum{}, start, -2, makeTableau<double>("radau_iia_5"), options);
  EXPECT_EQ(failed.outcome, Outcome::kMaxSteps);
  EXPECT_TRUE(contains(failed.detail, "at t = -0."));
  EXPECT_LT(failed.state.t, 0);
  for (const auto formulation : {Formulation::kIndex2, Formulation::kGgl, Formulation::kFirstOrder}) {
    start.t = -1;
    start.v[0] = 3;
    const auto inconsistent =
        integrate<double>(DrivenPendulum{}, start, -2, makeTableau<double>("radau_iia_5"), options, formulation);
    EXPECT_EQ(inconsistent.outcome, Outcome::kInconsistentStart);
    EXPECT_TRUE(contains(inconsistent.detail, " at t = -1"));
  }
}

TEST(Backward, TheErrorBarIsTheError) {
  const auto start = startOf(Riccati{}, {.t = 2, .x = {1.5 + std::sin(2.0)}});
  const MeasuredRun run = measuredRun(Riccati{}, start, 0.5, adaptive(1e-6));
  const double error = std::abs(run.first.state.x[0] - (1.5 + std::sin(0.5)));
  EXPECT_EQ(run.second.state.t, 0.5);
  EXPECT_GT(run.bar.x[0], error / 3);
  EXPECT_LT(run.bar.x[0], error * 3);
}

/// x' = 0 with a mode, and a jump that the members say.
struct OneWayJump {
  Index discrete = 0, switches = 0;
  double factor = 1, added = 0;  // at t = 1, x becomes factor x + added
  Sizes sizes() const {
    return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0, .discrete = discrete, .switches = switches};
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = -p.k[0];
  }
  template <class T>
  void switching(const Point<T>&, T* g) const {
    for (Index i = 0; i < switches; ++i) g[i] = T(-1.0);
  }
  template <class T>
  void onSwitch(Index, const Point<T>&, T*) const {}
  std::vector<double> times() const { return {1}; }
  template <class T>
  void jumpAtTime(Index, const Point<T>& p, T*, T*, T* x) const {
    x[0] = factor * p.x[0] + added;
  }
};

TEST(Backward, RefusesWhatCannotBeUndone) {
  struct Case {
    const char* what;
    OneWayJump problem;
    const char* message;  // empty: it works
  };
  const std::vector<Case> cases{
      {"a time without a jump", {}, ""},
      {"a switch", {.switches = 1}, "the system has 1 switches"},
      {"a mode", {.discrete = 2}, "a discrete state of 2 numbers"},
      {"a jump", {.added = 1}, "the state jumps at t = 1, time 0 (from 0 on)"},
      {"a jump to zero, where the state is", {.factor = 0}, "the state jumps at t = 1"},
  };
  for (const Case& one : cases) {
    for (const auto formulation : {Formulation::kIndex2, Formulation::kFirstOrder}) {
      SCOPED_TRACE(one.what);
      const auto start = startOf(one.problem, {.t = 2});
      Integrator<double> integrator(makeSystem<double>(one.problem, {formulation}), makeTableau<double>("radau_iia_5"),
                                    adaptive(1e-6));
      const auto message = refusal([&] { EXPECT_EQ(integrator.integrate(start, 0).outcome, Outcome::kSuccess); });
      EXPECT_EQ(message.empty(), *one.message == 0) << message;
      EXPECT_TRUE(contains(message, one.message));
      EXPECT_EQ(integrator.integrate(start, 3).outcome, Outcome::kSuccess) << "forward";
    }
  }
}

}  // namespace
}  // namespace irk::test
