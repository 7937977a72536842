// Remarks on components far below their tolerance, and below zero where they cannot be.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/integration/amounts.h"
#include "tests/core/switching_run.h"

namespace irk::test {
namespace {

/// x_0' = -1, x_1' = -1, and x_1 is said to be never negative. From (1, 1) it is false after t = 1. The mass, held at
/// u = 0, makes GGL and first-order form have other unknowns than the scene.
struct Emptying {
  Sizes sizes() const { return {.nu = 1, .nx = 2, .nz = 1, .constraints = 1}; }
  bool nonNegative(Index i) const { return i == 1; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -p.a[0] - p.z[0];
    r.x[0] = -1 - p.k[0];
    r.x[1] = -1 - p.k[1];
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    g[0] = u[0];
  }
};

constexpr double kEmptyTol = 1e-4, kEmptyScale = 10;  // kEmptyScale: of x_1; the others have 1

Solution<double> emptied(double t_end, const IntegratorOptions& options, Formulation form = Formulation::kIndex2) {
  const auto start = startOf(Emptying{}, {.x = {1, 1}});
  const auto system = makeSystem<double>(Emptying{}, {form});
  Vec<double> scale = Vec<double>::Ones(system->sizes().components());
  scale[3] = kEmptyScale;  // x_1: every form begins with u, v, x_0, x_1
  Integrator<double> integrator(system, makeTableau<double>("radau_iia_3"), options, scale);
  return integrator.integrate(start, t_end);
}

bool remarks(const Solution<double>& s, const std::string& text) { return s.detail.find(text) != std::string::npos; }

TEST(Amounts, ANegativeResultIsNamedWhereItCannotBe) {
  constexpr double kAllowed = kEmptyTol * kEmptyScale;  // one tolerance at zero
  for (const IntegratorOptions& options : {adaptive(kEmptyTol), embedded(kEmptyTol)}) {
    for (const Formulation form : {Formulation::kIndex2, Formulation::kGgl, Formulation::kFirstOrder}) {
      const Solution<double> below = emptied(1 + 1.2 * kAllowed, options, form);
      EXPECT_EQ(below.outcome, Outcome::kSuccess);
      const char* const name = form == Formulation::kIndex2 ? "x[1]" : "x[3]";
      EXPECT_TRUE(
          remarks(below, std::string(name) + " falls to -0.0012 at t = 1, but it is never negative on an exact"))
          << below.detail;
      const Solution<double> within = emptied(1 + 0.9 * kAllowed, options, form);
      EXPECT_EQ(within.outcome, Outcome::kSuccess) << within.detail;
      EXPECT_FALSE(remarks(within, "falls to")) << within.detail;
    }
  }
}

// x_0 of Emptying crosses zero as its rate tells; so do the two of an oscillator.
struct FirstOrderOscillator {
  Sizes sizes() const { return {.nx = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = p.x[1] - p.k[0];
    r.x[1] = -p.x[0] - p.k[1];
  }
};
/// x_0 decays to -below, faster than a coarse step can follow. For below = 0 it is a population: its rate at zero is
/// zero.
struct FastDecay {
  double below;
  Sizes sizes() const { return {.nx = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = -1000 * (p.x[0] + below) - p.k[0];
    r.x[1] = p.x[0] - p.x[1] - p.k[1];
  }
};

TEST(Amounts, WhatMayCrossZeroIsNotNamed) {
  const auto start = startOf(FirstOrderOscillator{}, {.x = {1, 0.5}});
  for (const IntegratorOptions& options : {adaptive(kEmptyTol), embedded(kEmptyTol), adaptive(1e-9), embedded(1e-9)}) {
    const auto swing =
        integrate<double>(FirstOrderOscillator{}, start, 20, makeTableau<double>("radau_iia_7"), options);
    EXPECT_EQ(swing.detail, "");
    const auto falls = integrate<double>(FastDecay{0.1}, start, 1, makeTableau<double>("radau_iia_3"), options);
    EXPECT_LT(falls.state.x[0], -0.09);
    EXPECT_EQ(falls.detail, "");
  }
}

/// x' = 0 before t = 2 and -1 from then on.
struct LaterFalling {
  Sizes sizes() const { return {.nx = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = (p.t < T(2) ? T(0) : T(-1)) - p.k[0];
    r.x[1] = -p.k[1];
  }
};

/// x_0' = 100 (x_1 - x_0): x_0 cannot cross zero as long as x_1 >= 0.
struct Fed {
  Sizes sizes() const { return {.nx = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = 100 * (p.x[1] - p.x[0]) - p.k[0];
    r.x[1] = -p.k[1];
  }
};

/// The remark on steps from one of these values of x_0 to the next, one per unit of time. x_1 goes from 1 to `second`.
template <class P>
std::string remarkOn(const P& problem, const std::vector<double>& values, double second = 1) {
  constexpr double tol = 0.01;
  const auto system = makeSystem<double>(problem, {});
  Counters counters;
  ConsistentStart<double> start(*system, DerivativeSource::kAutomatic, false, &counters);
  ErrorNorm<double> norm(*system, {tol, tol}, {});
  Amounts<double> amounts(*system, start, counters);
  State<double> from(problem.sizes()), to = from;
  from.x << values[0], 1;
  amounts.begin(from, norm);
  for (std::size_t i = 1; i < values.size(); ++i) {
    to.t = from.t + 1;
    to.x << values[i], second;
    amounts.look(from, to);
    from = to;
  }
  EXPECT_EQ(counters.jacobians, 0);
  return amounts.remark();
}

// Computed steps below zero, made by hand: whether the exact solution can go there, the rate at zero says.
TEST(Amounts, AnUndeclaredAmountBelowZeroIsNamed) {
  EXPECT_EQ(remarkOn(FastDecay{0}, {0.5, -0.05}),
            "x[0] falls to -0.05 at t = 1, but its rate at zero does not lead below zero");
  EXPECT_EQ(remarkOn(FastDecay{0}, {0.5, 0.1, -0.02, -0.07, 0.3}),
            "x[0] falls to -0.07 at t = 3, but its rate at zero does not lead below zero");
  EXPECT_EQ(remarkOn(FastDecay{0}, {0.5, -0.009}), "") << "within the tolerance";
  EXPECT_EQ(remarkOn(FastDecay{0}, {-0.5, -0.6}), "") << "negative from the start";
  EXPECT_EQ(remarkOn(FastDecay{0.1}, {0.5, -0.05}), "") << "the exact solution goes to -0.1";
}

// Another component that is below zero by less than its tolerance does not make the rate lead there: it is zero.
TEST(Amounts, OthersNextToZeroAreTakenAsZero) {
  const std::string named = "x[0] falls to -0.05 at t = 1, but its rate at zero does not lead below zero";
  EXPECT_EQ(remarkOn(Fed{}, {0.5, -0.05}), named);
  EXPECT_EQ(remarkOn(Fed{}, {0.5, -0.05}, -0.009), named);
  EXPECT_EQ(remarkOn(Fed{}, {0.5, -0.05}, -0.5),
            "x[1] falls to -0.5 at t = 1, but its rate at zero does not lead below zero")
      << "x_0 follows x_1";
}

TEST(Amounts, OneCrossingAsTheRateTellsClearsAComponent) {
  EXPECT_NE(remarkOn(LaterFalling{}, {0.5, -0.5}), "");
  EXPECT_NE(remarkOn(LaterFalling{}, {0.5, -0.5, 0.5, 0.5}), "");
  EXPECT_EQ(remarkOn(LaterFalling{}, {0.5, -0.5, 0.5, 0.5, -0.5}), "");
}

/// Components that follow sin t closely, by 1e6 (m - x_i) with their mean m: their rates have a round-off of 1e-10.
/// From `shift` below that.
struct ManySwinging {
  static constexpr Index kCount = 60;
  double shift;
  long* evaluations;
  Sizes sizes() const { return {.nx = kCount}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    ++*evaluations;
    T mean = p.x[0] * 0.0;
    for (Index i = 0; i < kCount; ++i) mean += (p.x[i] + shift) / static_cast<double>(kCount);
    for (Index i = 0; i < kCount; ++i) {
      r.x[i] = 1e6 * (mean - (p.x[i] + shift)) + cos(p.t) * (1.0 + 0.1 * static_cast<double>(i % 3)) - p.k[i];
    }
  }
};

long evaluationsOf(double shift) {
  long evaluations = 0;
  const ManySwinging swinging{shift, &evaluations};
  State<double> start(swinging.sizes());
  start.x.setConstant(0.01 - shift);
  const auto swing = integrate<double>(swinging, start, 10, makeTableau<double>("radau_iia_3"), embedded(1e-4));
  EXPECT_EQ(swing.outcome, Outcome::kSuccess) << swing.detail;
  EXPECT_EQ(swing.detail, "");
  return evaluations;
}

TEST(Amounts, ManyThatCrossZeroTakeFewEvaluations) { EXPECT_LT(10 * evaluationsOf(0), 13 * evaluationsOf(5)); }

/// A -> C in any amounts: A = a0 e^-t, C = a0 - A.
struct TinyAmounts {
  Sizes sizes() const { return {.nx = 3}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T& rate = p.x[0];
    r.x[0] = -rate - p.k[0];
    r.x[1] = rate - p.k[1];
    r.x[2] = 0.0 * p.x[2] - p.k[2];  // always zero, and right
  }
};

TEST(Amounts, ComponentsThatNeverReachTheirToleranceAreNamed) {
  for (const double tol : {1e-4, 1e-8}) {
    const auto run = [tol](double a0) {
      const auto start = startOf(TinyAmounts{}, {.x = {a0, 0, 0}});
      return integrate<double>(TinyAmounts{}, start, 9, makeTableau<double>("radau_iia_5"), adaptive(tol));
    };
    const auto tiny = run(1e-13);
    EXPECT_EQ(tiny.outcome, Outcome::kSuccess) << tiny.detail;
    EXPECT_TRUE(remarks(tiny, "x[0], x[1] stayed below the absolute tolerance")) << tiny.detail;
    const auto usual = run(1);
    EXPECT_EQ(usual.detail, "");
    EXPECT_NEAR(usual.state.x[0], std::exp(-9.0), 100 * tol);
  }
}

// Fixed steps have no tolerance.
TEST(Amounts, FixedStepsNameNothing) { EXPECT_EQ(emptied(2, fixedSteps(0.1)).detail, ""); }

}  // namespace
}  // namespace irk::test
