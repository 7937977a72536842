// Residuals that do not depend on v: the v of stages are left out.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "irk/integrator.h"
#include "irk/misuse.h"
#include "irk/problem.h"
#include "irk/scene.h"
#include "irk/tableaus.h"
#include "irk/vanishes.h"
#include "tests/refusal.h"

namespace irk::test {
namespace {

/// Two coupled pendulums under a force, nonlinear, non-autonomous, with a first-order equation.
template <class Real>
struct Undamped {
  Real length;
  bool declared = true;
  Real damping = Real(0.0);
  double damped_from = 0;
  Sizes sizes() const { return {.nu = 2, .nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    r.u[0] = (-1 / length) * sin(p.u[0]) + p.u[1] * p.x[0] + cos(p.t) - p.a[0];
    r.u[1] = -p.u[1] * p.u[1] * p.u[1] - p.u[1] + p.u[0] - (1 + p.u[0] * p.u[0]) * p.a[1];
    r.x[0] = p.u[1] - p.x[0] - p.k[0];
    if (!vanishes(damping) && p.t >= damped_from) r.u[0] -= damping * p.v[0];
  }
  bool usesVelocity() const { return !declared; }
  static void start(State<double>& s) {
    s.u << 1, -0.5;
    s.v << 0.3, 0.2;
  }
};

Solution<double> solved(const Undamped<double>& problem, const IntegratorOptions& options,
                        Formulation formulation = Formulation::kIndex2) {
  const auto system = makeSystem<double>(problem, {formulation});
  State<double> start(system->sceneSizes());
  Undamped<double>::start(start);
  return Integrator<double>(system, makeTableau<double>("radau_iia_3"), options).integrate(start, 3);
}

// The twin computes the same v and does not read them.
void expectTwin(const IntegratorOptions& options, Formulation formulation = Formulation::kIndex2) {
  const auto with = solved({1.3, false}, options, formulation), without = solved({1.3, true}, options, formulation);
  ASSERT_EQ(with.outcome, Outcome::kSuccess) << with.detail;
  ASSERT_EQ(without.outcome, Outcome::kSuccess) << without.detail;
  EXPECT_EQ(with.state.u, without.state.u);
  EXPECT_EQ(with.state.v, without.state.v);
  EXPECT_EQ(with.state.x, without.state.x);
  EXPECT_EQ(with.state.w, without.state.w);
  EXPECT_EQ(with.counters.newton_iterations, without.counters.newton_iterations);
}

TEST(VelocityFree, ResultsEqualThoseOfATwinThatComputesV) {
  for (const auto& estimate : {ErrorEstimate::kEmbedded, ErrorEstimate::kRichardson}) {
    for (const auto& source : {DerivativeSource::kAutomatic, DerivativeSource::kCentral, DerivativeSource::kForward}) {
      for (const auto& at : {JacobianPoint::kStart, JacobianPoint::kMiddle, JacobianPoint::kPredicted}) {
        IntegratorOptions options;
        options.step.estimate = estimate;
        options.derivatives = source;
        options.jacobian_point = at;
        expectTwin(options);
      }
    }
  }
}

TEST(VelocityFree, OtherFormulationsAndFullNewtonEqualTheTwin) {
  for (const auto formulation : {Formulation::kIndex3, Formulation::kGgl, Formulation::kFirstOrder}) {
    expectTwin({}, formulation);
  }
  IntegratorOptions full;
  full.newton.kind = NewtonKind::kFull;
  full.solver = StageSolverKind::kCoupledDense;
  expectTwin(full);
}

// If the declaration is wrong, nothing computes with a wrong v.
TEST(VelocityFree, AResidualThatReadsVAllTheSameIsRefused) {
  EXPECT_EQ(solved({1.3, false, 0.1}, {}).outcome, Outcome::kSuccess);
  EXPECT_EQ(refusal([] {
              solved({1.3, true, 0.1}, {});
            }),
            "usesVelocity() is false, but row 0 of the residual (from 0 on) reads v");
}

/// Friction as a branch: with v = NaN it is finite, and wrong.
struct Braked {
  Sizes sizes() const { return {.nu = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = (p.v[0] > T(0.0) ? T(-0.5) : T(0.5)) - p.a[0];
  }
  bool usesVelocity() const { return false; }
};

TEST(VelocityFree, ABranchOnVIsRefusedAtEveryStart) {
  const auto system = makeSystem<double>(Braked{});
  for (const double v : {-2.0, 0.0, 2.0}) {
    State<double> start(system->sizes());
    start.v << v;
    EXPECT_THROW(
        static_cast<void>(Integrator<double>(system, makeTableau<double>("radau_iia_3"), {}).integrate(start, 1)),
        Misuse)
        << v;
  }
}

// A residual that begins to read v later is not finite from there on.
TEST(VelocityFree, AResidualThatReadsVLaterFails) {
  const auto solution = solved({1.3, true, 0.1, 1}, {});
  EXPECT_EQ(solution.outcome, Outcome::kNotFinite) << solution.detail;
  EXPECT_LE(solution.state.t, 1);
}

TEST(VelocityFree, WhatScenesDeclareIsTrue) {
  int declared = 0;
  for (const SceneEntry& entry : sceneCatalogue()) {
    const Scene<double> scene = makeScene<double>(entry.id, {});
    for (const Formulation formulation : {Formulation::kIndex2, Formulation::kIndex3}) {
      const auto system = scene.system({formulation});
      if (system->usesVelocity()) continue;
      ++declared;
      State<double> state = system->fromScene(scene.start);
      const Index n = system->sizes().n();
      Vec<double> r(n), without(n);
      system->evaluate(Level::kFormulated, pointOf(state), {r.data(), n});
      state.v.setConstant(std::numeric_limits<double>::quiet_NaN());
      system->evaluate(Level::kFormulated, pointOf(state), {without.data(), n});
      EXPECT_EQ(r, without) << entry.id;
    }
  }
  EXPECT_EQ(declared, 2 * 4) << "kepler, elastica, ancf_cantilever, ancf_pendulum";
}

}  // namespace
}  // namespace irk::test
