// The error bar where components are below their absolute tolerance and matter later.
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "tests/core/error_bar_run.h"
#include "tests/refusal.h"

namespace irk::test {
namespace {

void expectCovered(const Vec<double>& bars, const Vec<double>& result, const Vec<double>& exact, double tol) {
  for (Index i = 0; i < exact.size(); ++i) {
    const double error = std::abs(result[i] - exact[i]);
    EXPECT_LE(error, 3 * (bars[i] + tol)) << "component " << i << " tol " << tol;
    EXPECT_LE(bars[i], 1.1 * error + tol) << "component " << i << " tol " << tol;
  }
}

/// A spiral that grows or decays with t - turn: x = r (cos w t, sin w t), r = r0 e^(t^2 / 2 - turn t). A delayed loss
/// of stability: both components fall far below any tolerance and come back.
struct SlowPassage {
  double turn = 0;
  double frequency = 3;
  Sizes sizes() const { return {.nx = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T growth = p.t - turn;
    r.x[0] = growth * p.x[0] - frequency * p.x[1] - p.k[0];
    r.x[1] = frequency * p.x[0] + growth * p.x[1] - p.k[1];
  }
  Vec<double> exact(double r0, double t) const {
    const double r = r0 * std::exp(t * (t / 2 - turn));
    return Vec<double>{{r * std::cos(frequency * t), r * std::sin(frequency * t)}};
  }
};

TEST(ErrorBarOfSmallComponents, CoversWhatComesBackFromFarBelowTheTolerance) {
  for (const double turn : {0.0, 4.0, 9.0}) {  // with 9, r falls to 2.6e-18
    const SlowPassage problem{turn};
    const double r0 = turn == 0 ? 1e-9 : 1;
    const auto start = startOf(problem, {.x = {r0, 0}});
    const double t_end = turn == 0 ? 6.4 : 2 * turn;  // r is about 1
    for (const NormKind norm : {NormKind::kMixed, NormKind::kAbsolute}) {
      for (const double tol : {1e-3, 1e-5, 1e-8}) {
        IntegratorOptions options = embedded(tol);
        options.tolerances.norm = norm;
        const MeasuredRun run = measuredRun(problem, start, t_end, options);
        expectCovered(run.bar.x, run.first.state.x, problem.exact(r0, t_end), tol);
        // What the bar is for: without a doubt of a result that is wrong.
        if (tol == 1e-3) {
          EXPECT_GT(run.bar.tolerances, 100) << turn;
        }
      }
    }
  }
}

TEST(ErrorBarOfSmallComponents, CoversAnUnstableEquilibriumInSecondOrderForm) {
  const SecondOrder problem{[](const auto& p) { return 100.0 * p.u[0]; }};  // a pendulum that stands upright
  const auto start = startOf(problem, {.u = {1e-9}});  // and u' = 0: one of the components begins with zero
  const double t_end = 2.1, turns = 10 * t_end;
  for (const double tol : {1e-3, 1e-4}) {
    const MeasuredRun run = measuredRun(problem, start, t_end, embedded(tol));
    expectCovered(run.bar.u, run.first.state.u, Vec<double>{{1e-9 * std::cosh(turns)}}, tol);
    expectCovered(run.bar.v, run.first.state.v, Vec<double>{{1e-8 * std::sinh(turns)}}, 10 * tol);
    EXPECT_GT(run.bar.tolerances, 100);
  }
}

/// A pendulum in its angle, measured from the horizontal: it stands upright at `rest`, and hangs at rest + pi.
struct DampedPendulum {
  double rest, damping;
  Sizes sizes() const { return {.nu = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sin;
    r.u[0] = 100.0 * sin(p.u[0] - rest) - damping * p.v[0] - p.a[0];
  }
};

// Its velocity stays below the tolerance, but not its position: near round-off there is nothing to control, and how it
// leaves the rest is followed by its growth.
TEST(ErrorBarOfSmallComponents, AVelocityAtARestAwayFromZeroIsNoneOfThem) {
  for (const double damping : {1.0, 10.0, 30.0}) {
    for (const double deviation : {1e-9, -1e-12, 1e-14}) {
      for (const double tol : {1e-4, 1e-7}) {
        const DampedPendulum problem{1.5, damping};
        const auto start = startOf(problem, {.u = {problem.rest + deviation}});
        const MeasuredRun run = measuredRun(problem, start, 40, embedded(tol));
        EXPECT_EQ(run.bar.remark, "") << damping << ' ' << deviation << ' ' << tol;
        EXPECT_LT(run.steps, 5000) << damping << ' ' << deviation << ' ' << tol;
        EXPECT_NEAR(run.second.state.u[0], problem.rest + std::copysign(M_PI, deviation), 10 * tol) << damping;
      }
    }
  }
}

// A fast motion far below the tolerance would take 1e6 steps. The effort has a limit, and the bar is then that of the
// second integration.
TEST(ErrorBarOfSmallComponents, GivesUpWhereThatTakesTooManySteps) {
  const FirstOrder problem{[](const auto& p) {
    using std::sin;
    return -p.x[0] + 1e-8 * sin(1e6 * p.t);
  }};
  const MeasuredRun run = measuredRun(problem, startOf(problem, {.x = {1e-14}}), 1, embedded(1e-3));
  EXPECT_LT(run.bar.tolerances, 1);
  EXPECT_GT(run.steps, 5000);
  EXPECT_LT(run.steps, 20000 + 1000);  // constants.h: 20 000 / unknowns
  EXPECT_TRUE(contains(run.bar.remark, "x[0], below the absolute tolerance"));
  EXPECT_TRUE(contains(run.bar.remark, "takes too many steps"));
}

/// An oscillator, whose velocity begins with zero, beside this fast motion.
struct OscillatorBesideFastAndSmall {
  Sizes sizes() const { return {.nu = 1, .nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sin;
    r.u[0] = -p.u[0] - p.a[0];
    r.x[0] = -p.x[0] + 1e-8 * sin(1e6 * p.t) - p.k[0];
  }
};

// The velocity is small in the first, tiny step only.
TEST(ErrorBarOfSmallComponents, TheRemarkNamesTheOneThatStaysSmall) {
  const auto start = startOf(OscillatorBesideFastAndSmall{}, {.u = {1}, .x = {1e-14}});
  const MeasuredRun run = measuredRun(OscillatorBesideFastAndSmall{}, start, 1, embedded(1e-3));
  EXPECT_TRUE(contains(run.bar.remark, "what comes of x[0], below"));
}

/// A pendulum beside a component x = 1e-9 e^(10 t): position constraints have multipliers.
struct PendulumBesideGrowth : OnUnitCircle {
  Sizes sizes() const { return {.nu = 2, .nx = 1, .nz = 1, .constraints = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -p.u[0] * p.z[0] - p.a[0];
    r.u[1] = -9.81 - p.u[1] * p.z[0] - p.a[1];
    r.x[0] = 10.0 * p.x[0] - p.k[0];
  }
};

// An exception leaves the integration, and the integrator weighs errors as before.
TEST(ErrorBarOfSmallComponents, LeavesTheWeightsAfterAnException) {
  const SlowPassage problem{0.0};
  const auto start = startOf(problem, {.x = {1e-9, 1e-9}}), result = startOf(problem, {.t = 6});
  const IntegratorOptions options = embedded(1e-4);
  auto second = secondOf(makeSystem<double>(problem), options);
  const std::int64_t before = second.integrate(start, 6).counters.steps_accepted;
  Monitor<double> monitor;
  int steps = 0;
  monitor.accepted = [&](const StepRecord<double>&) {
    if (++steps == 20) throw std::runtime_error("enough");
  };
  Solution<double> other;
  EXPECT_THROW(static_cast<void>(measureErrorBar(result, second, start, options.tolerances, {}, other, monitor)),
               std::runtime_error);
  EXPECT_EQ(second.integrate(start, 6).counters.steps_accepted, before);
}

// In index 1 the system has no multipliers, which the scene has.
TEST(ErrorBarOfSmallComponents, HoldsInFormulationsWithoutMultipliers) {
  const PendulumBesideGrowth problem;
  const auto start = startOf(problem, {.u = {1, 0}, .x = {1e-9}});
  for (const Formulation formulation : {Formulation::kIndex1, Formulation::kIndex2, Formulation::kGgl}) {
    const MeasuredRun run = measuredRun(problem, start, 2, embedded(1e-4), formulation);
    expectCovered(run.bar.x, run.first.state.x, Vec<double>{{1e-9 * std::exp(20.0)}}, 1e-4);
  }
}

// A component that passes through zero is not small: one integration is enough.
TEST(ErrorBarOfSmallComponents, DoesNotTakeZerosForSmallComponents) {
  const SlowPassage oscillator{-1e-12, 3};  // its growth is t: integrate over a short time
  const MeasuredRun run = measuredRun(oscillator, startOf(oscillator, {.x = {1, 0}}), 1.5, embedded(1e-4));
  EXPECT_EQ(run.steps, run.second.counters.steps_accepted);
}

/// An oscillator u'' = -u, which begins at rest, beside x = 1e-9 e^(0.01 t).
struct OscillatorBesideGrowth {
  Sizes sizes() const { return {.nu = 1, .nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -p.u[0] - p.a[0];
    r.x[0] = 0.01 * p.x[0] - p.k[0];
  }
};

// The velocity begins with zero, and the steps resolve x: one integration is enough.
TEST(ErrorBarOfSmallComponents, DoesNotTakeAccurateOnesForSmall) {
  const auto start = startOf(OscillatorBesideGrowth{}, {.u = {1}, .x = {1e-9}});
  const MeasuredRun run = measuredRun(OscillatorBesideGrowth{}, start, 20, embedded(1e-4));
  EXPECT_EQ(run.steps, run.second.counters.steps_accepted);
}

// The norm weighs errors by the new scale, and by that of the constructor again.
TEST(ErrorWeights, AreThoseOfTheScaleThatWasGivenLast) {
  const SlowPassage problem{2};
  const auto start = startOf(problem, {.x = {1, 0.5}});
  Integrator<double> integrator(makeSystem<double>(problem, {}), makeTableau<double>("radau_iia_3"), embedded(1e-4));
  const auto steps = [&] { return integrator.integrate(start, 4).counters.steps_accepted; };
  const std::int64_t before = steps();
  integrator.weighErrorsBy(Vec<double>::Constant(2, 1e-30));
  EXPECT_GT(steps(), before);
  integrator.weighErrorsBy(Vec<double>::Constant(1, 1e3));
  EXPECT_LE(steps(), before);
  integrator.weighErrorsBy({});
  EXPECT_EQ(steps(), before);
  EXPECT_THROW(integrator.weighErrorsBy(Vec<double>::Constant(2, 0.0)), Misuse);
  EXPECT_THROW(integrator.weighErrorsBy(Vec<double>::Constant(2, INFINITY)), Misuse);
  EXPECT_THROW(integrator.weighErrorsBy(Vec<double>::Ones(3)), Misuse);
}

// In time that runs backward, too.
TEST(ErrorWeights, HoldBackwardInTime) {
  const SlowPassage problem{2};
  const auto start = startOf(problem, {.t = 4, .x = {1, 0.5}});
  Integrator<double> integrator(makeSystem<double>(problem, {}), makeTableau<double>("radau_iia_3"), embedded(1e-4));
  const auto steps = [&] { return integrator.integrate(start, 0).counters.steps_accepted; };
  integrator.weighErrorsBy(Vec<double>::Constant(2, 1e-30));
  const std::int64_t relative = steps();
  integrator.weighErrorsBy({});
  EXPECT_GT(relative, steps());
}

}  // namespace
}  // namespace irk::test
