// Times that a system declares: steps end exactly there, and nothing of the steps before is used after.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "irk/ggl.h"
#include "irk/misuse.h"
#include "tests/core/support.h"

namespace irk::test {
namespace {

const std::vector<double> kTimes{std::sqrt(0.1), std::sqrt(0.9), 1.5};

/// x' = -x + cos t + 100 d, d grows by 1 at each time: x = x_0 e^-(t - t_0) + particular solutions, exact in pieces.
struct Pulses {
  bool declares = true;
  std::vector<double> at = kTimes;
  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0, .discrete = 1, .switches = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    r.x[0] = -p.x[0] + cos(p.t) + 100 * p.d[0] - p.k[0];
  }
  std::vector<double> times() const { return declares ? at : std::vector<double>{}; }
  template <class T>
  void onTime(Index i, const Point<T>&, T* d) const {
    d[0] = static_cast<double>(i + 1);
  }
  // (cos t + sin t) / 2 is a particular solution for d = 0; each pulse adds 100 (1 - e^-(t - t_i)).
  double exact(double t) const {
    double x = (std::cos(t) + std::sin(t)) / 2 - std::exp(-t) / 2;
    for (const double start : at) {
      if (t > start) x += 100 * (1 - std::exp(start - t));
    }
    return x;
  }
};

struct Integrated {
  Solution<double> solution;
  std::vector<double> ends;
};

Integrated integratePulses(const Pulses& problem, const IntegratorOptions& options, double t_end,
                           Formulation formulation = Formulation::kIndex2) {
  Integrated run;
  Monitor<double> monitor;
  monitor.accepted = [&](const StepRecord<double>& step) { run.ends.push_back(step.t); };
  Integrator<double> integrator(makeSystem<double>(problem, {.formulation = formulation}),
                                makeTableau<double>("radau_iia_5"), options);
  run.solution = integrator.integrate(State<double>(problem.sizes()), t_end, monitor);
  return run;
}

void expectStepsEndAtTimes(const Integrated& run) {
  for (const double t : kTimes) {
    EXPECT_NE(std::find(run.ends.begin(), run.ends.end(), t), run.ends.end()) << t;
  }
}

TEST(Times, StepsOfAnySizeEndThere) {
  const auto options = adaptive(1e-11);
  for (const auto formulation : {Formulation::kIndex2, Formulation::kFirstOrder}) {
    const Integrated run = integratePulses({}, options, 2, formulation);
    ASSERT_EQ(run.solution.outcome, Outcome::kSuccess) << run.solution.detail;
    expectStepsEndAtTimes(run);
    EXPECT_NEAR(run.solution.state.x[0], Pulses{}.exact(2), 1e-8);
    EXPECT_EQ(run.solution.state.d[0], 3);
  }
}

TEST(Times, FixedStepsAreSplitThere) {
  const Integrated run = integratePulses({}, fixedSteps(0.125), 2);
  ASSERT_EQ(run.solution.outcome, Outcome::kSuccess) << run.solution.detail;
  expectStepsEndAtTimes(run);
  EXPECT_EQ(run.ends.size(), 16u + 2u);  // 1.5 is a multiple of h
  EXPECT_NEAR(run.solution.state.x[0], Pulses{}.exact(2), 1e-9);
}

TEST(Times, AtTheEndAndTheStartNothingHappens) {
  const auto options = adaptive(1e-11);
  const Integrated at_end = integratePulses({}, options, kTimes.front());
  EXPECT_EQ(at_end.solution.state.d[0], 0);
  EXPECT_NEAR(at_end.solution.state.x[0], Pulses{}.exact(kTimes.front()), 1e-9);
  Pulses at_start;
  at_start.at = {0};
  EXPECT_EQ(integratePulses(at_start, options, 1).solution.state.d[0], 0);
}

// Sums and products of sampling times differ in their last digits: 3 * 0.1 and 0.3. No step fits between them.
TEST(Times, ThatDifferByRoundOffAreAllPassed) {
  Pulses close;
  const double next = std::nextafter(0.3, 1), end = std::nextafter(0.8, 1);
  close.at = {1e-40, 0.3, next, 0.8};
  for (const auto& options : {adaptive(1e-11), embedded(1e-11), fixedSteps(0.125)}) {
    const Integrated run = integratePulses(close, options, end);
    ASSERT_EQ(run.solution.outcome, Outcome::kSuccess) << run.solution.detail;
    EXPECT_EQ(run.solution.state.t, end);
    EXPECT_EQ(run.solution.state.d[0], 4);
    EXPECT_NEAR(run.solution.state.x[0], close.exact(end), 1e-8);
  }
}

TEST(Times, OutOfOrderAreRefused) {
  Pulses problem;
  problem.at = {1, 0.5};
  EXPECT_THROW((void)makeSystem<double>(problem), Misuse);
  problem.at = {std::nan("")};
  EXPECT_THROW((void)makeSystem<double>(problem), Misuse);
}

/// A kink of |t - 1|^1 in a constrained system: no discrete state. u = (cos phi, sin phi), phi'' = |t - 1|.
struct Wheel {
  Sizes sizes() const { return {.nu = 2, .nx = 0, .nz = 1, .constraints = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T force = p.t > T(1.0) ? T(p.t - 1) : T(1 - p.t);
    r.u[0] = -p.a[0] - p.u[1] * force - p.u[0] * p.z[0];
    r.u[1] = -p.a[1] + p.u[0] * force - p.u[1] * p.z[0];
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    g[0] = (u[0] * u[0] + u[1] * u[1] - 1) * 0.5;
  }
  std::vector<double> times() const { return {1}; }
};

TEST(Times, KinksNeedNoModeInAnyFormulation) {
  const double t = 2, phi = t * t / 2 - t * t * t / 6 + (t - 1) * (t - 1) * (t - 1) / 3;
  for (const auto formulation : {Formulation::kIndex1, Formulation::kIndex2, Formulation::kIndex3, Formulation::kGgl}) {
    State<double> start({.nu = 2, .nx = 0, .nz = 1, .constraints = 1});
    start.u << 1, 0;
    Integrator<double> integrator(makeSystem<double>(Wheel{}, {.formulation = formulation}),
                                  makeTableau<double>("radau_iia_7"), fixedSteps(0.3));
    const auto solution = integrator.integrate(start, t);
    ASSERT_EQ(solution.outcome, Outcome::kSuccess) << idOf(formulation) << solution.detail;
    EXPECT_NEAR(solution.state.u[0], std::cos(phi), 1e-10) << idOf(formulation);
    EXPECT_NEAR(solution.state.u[1], std::sin(phi), 1e-10) << idOf(formulation);
  }
}

/// A wheel that blows make faster: at the times i = 0, 1, ... phi' grows by i + 1. phi'' = 0, and phi' = 1 at first.
struct Blows : Wheel {
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -p.a[0] - p.u[0] * p.z[0];
    r.u[1] = -p.a[1] - p.u[1] * p.z[0];
  }
  std::vector<double> times() const { return {0.5, 1.2}; }
  template <class T>
  void jumpAtTime(Index i, const Point<T>& p, T*, T* v, T*) const {
    v[0] -= static_cast<double>(i + 1) * p.u[1];
    v[1] += static_cast<double>(i + 1) * p.u[0];
  }
};

// Times of data join those of the problem, whose numbers stay theirs. One of them is both.
TEST(Times, StatesJumpThereInAnyFormulationAndBesideKinksOfData) {
  const double t = 2, phi = 0.5 + 2 * 0.7 + 4 * 0.8;
  for (const auto formulation : {Formulation::kIndex1, Formulation::kIndex2, Formulation::kIndex3, Formulation::kGgl,
                                 Formulation::kFirstOrder}) {
    State<double> start({.nu = 2, .nx = 0, .nz = 1, .constraints = 1});
    start.u << 1, 0;
    start.v << 0, 1;
    const auto system = makeSystem<double>(Blows{}, {.formulation = formulation}, {0.1, 0.5, 0.9, 1.9});
    EXPECT_EQ(system->times(), (std::vector<double>{0.1, 0.5, 0.9, 1.2, 1.9}));
    Integrator<double> integrator(system, makeTableau<double>("radau_iia_7"), adaptive(1e-10));
    const auto solution = integrator.integrate(start, t);
    ASSERT_EQ(solution.outcome, Outcome::kSuccess) << idOf(formulation) << solution.detail;
    EXPECT_NEAR(solution.state.u[0], std::cos(phi), 1e-8) << idOf(formulation);
    EXPECT_NEAR(solution.state.v[1], 4 * std::cos(phi), 1e-7) << idOf(formulation);
  }
}

/// x' = sin^2(pi (t - 1) / 4) from t = 1 to 9, else 0: x(10) = 4. The input vanishes at 1, 5 and 9, which are the nodes
/// of a step of length 8 with three Lobatto stages.
struct Asleep {
  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0, .discrete = 1, .switches = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sin;
    const T s = sin((3.14159265358979323846 / 4) * (p.t - 1.0));
    r.x[0] = p.d[0] * s * s - p.k[0];
  }
  std::vector<double> times() const { return {1, 9}; }
  template <class T>
  void onTime(Index i, const Point<T>&, T* d) const {
    d[0] = i == 0 ? 1.0 : 0.0;
  }
};

TEST(Times, AnInputThatVanishesAtAllNodesIsSeen) {
  for (const char* method : {"lobatto_iiid_3", "lobatto_iiic_3", "lobatto_iiic_2", "radau_ia_3", "radau_iia_3"}) {
    // The paper's doubling does not look between the stages.
    for (IntegratorOptions options : {adaptive(1e-6), embedded(1e-6)}) {
      options.step.h = 10;
      Integrator<double> integrator(makeSystem<double>(Asleep{}), makeTableau<double>(method), options);
      const auto solution = integrator.integrate(State<double>(Asleep{}.sizes()), 10);
      ASSERT_EQ(solution.outcome, Outcome::kSuccess) << method << ' ' << solution.detail;
      EXPECT_NEAR(solution.state.x[0], 4, 4e-4) << method;
    }
  }
}

/// A current that charges a capacitor with a diode: x' = i - (exp(40 x) - 1), with i = 1e6 from t = 10 on, 1 before.
struct SwitchedOn {
  Sizes sizes() const { return {.nx = 1, .discrete = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::exp;
    r.x[0] = p.d[0] - (exp(40.0 * p.x[0]) - 1.0) - p.k[0];
  }
  std::vector<double> times() const { return {10}; }
  template <class T>
  void onTime(Index, const Point<T>&, T* d) const {
    d[0] = 1e6;
  }
};

// The steps before t = 10 have grown to a size that is about 1e10 times too large for what follows. Halves and fifths
// of it would fail a dozen times.
TEST(Times, AFirstStepThatFailsIsFollowedByOneOfASizeForTheNewRates) {
  for (const double h_min : {0.0, 1e-9}) {
    IntegratorOptions options = embedded(1e-6);
    options.step.h_min = h_min;  // larger than the size for the new rates
    const auto start = startOf(SwitchedOn{}, {.x = {0.01}, .d = {1}});
    Integrator<double> integrator(makeSystem<double>(SwitchedOn{}), makeTableau<double>("radau_iia_3"), options);
    const auto solution = integrator.integrate(start, 100);
    ASSERT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
    EXPECT_NEAR(solution.state.x[0], std::log(1e6 + 1) / 40, 1e-6);
    EXPECT_GE(solution.counters.steps_rejected_newton, 1);
    EXPECT_LE(solution.counters.steps_rejected_newton, 3);
  }
}

}  // namespace
}  // namespace irk::test
