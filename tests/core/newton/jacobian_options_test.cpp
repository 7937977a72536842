#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <memory>
#include <type_traits>
#include <vector>

#include "core/control/controller.h"
#include "core/derivatives/differentiator.h"
#include "core/estimates/step_attempt.h"
#include "core/stages/error_norm.h"
#include "tests/core/support.h"
#include "tests/core/watched.h"

namespace irk::test {
namespace {

/// Records the points at which the residual is evaluated, over double and dual numbers. x' = t, u'' = sin u.
struct Asked {
  double t, u, k;
  bool dual;
};

struct Spy {
  std::shared_ptr<std::vector<Asked>> asked = std::make_shared<std::vector<Asked>>();
  Sizes sizes() const { return {.nu = 1, .nx = 1, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sin;
    r.u[0] = -sin(p.u[0]) - p.a[0];
    r.x[0] = p.t - p.k[0];
    if constexpr (std::is_same_v<T, double>) {
      asked->push_back({p.t, p.u[0], p.k[0], false});
    } else if constexpr (std::is_same_v<T, Dual<double>>) {
      asked->push_back({p.t.value, p.u[0].value, p.k[0].value, true});
    }
  }
};

State<double> spyStart() { return startOf(Spy{}, {.u = {0.5}, .v = {2}}); }

std::vector<Asked> askedBy(const IntegratorOptions& options, double t_end, const char* method) {
  const Spy spy;
  Integrator<double> integrator(makeSystem<double>(spy), makeTableau<double>(method), options);
  EXPECT_EQ(integrator.integrate(spyStart(), t_end).outcome, Outcome::kSuccess);
  return *spy.asked;
}

IntegratorOptions oneStep(double h) {
  IntegratorOptions o = fixedSteps(h);
  o.derivatives = DerivativeSource::kAutomatic;
  o.newton.kind = NewtonKind::kSimplified;
  o.newton.keep_jacobian_below = 0.999;
  o.solver = StageSolverKind::kCoupledDense;
  o.predictor = Predictor::kAcceleration;
  return o;
}

/// All components together follow cos t, and each has a cubic force: a full Jacobian that changes.
struct Full {
  Index n;
  Sizes sizes() const { return {.nx = n}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    T mean = p.x[0] * 0.0;
    for (Index i = 0; i < n; ++i) mean += p.x[i] / static_cast<double>(n);
    for (Index i = 0; i < n; ++i) r.x[i] = 10 * (mean - p.x[i]) - p.x[i] * p.x[i] * p.x[i] + cos(p.t) - p.k[i];
  }
};

Counters costsOfFull(Index n, double keep_below) {
  IntegratorOptions options = embedded(1e-5);
  options.newton.keep_jacobian_below = keep_below;
  const auto start = State<double>(Full{n}.sizes());
  const auto solved = integrate<double>(Full{n}, start, 10, makeTableau<double>("radau_iia_3"), options);
  EXPECT_EQ(solved.outcome, Outcome::kSuccess) << solved.detail;
  return solved.counters;
}

TEST(KeepJacobianBelow, IsATenthAtLeastWhereNewFactorsCostAStep) {
  EXPECT_GT(costsOfFull(39, 1e-3).jacobians, 2 * costsOfFull(39, 0.1).jacobians);
  EXPECT_EQ(costsOfFull(40, 1e-3).jacobians, costsOfFull(40, 0.1).jacobians);
  EXPECT_GT(costsOfFull(40, 0).jacobians, 2 * costsOfFull(40, 0.1).jacobians);
  EXPECT_LT(costsOfFull(40, 0.5).jacobians, costsOfFull(40, 0.1).jacobians);
}

TEST(JacobianPointOption, IsWhereTheDerivativesAreAsked) {
  const double h = 0.25, a0 = -std::sin(0.5);
  const auto duals = [&](JacobianPoint point) {
    IntegratorOptions o = oneStep(h);
    o.jacobian_point = point;
    std::vector<Asked> found;
    for (const auto& one : askedBy(o, h, "radau_iia_3")) {
      if (one.dual) found.push_back(one);
    }
    return found;
  };
  const auto last = [&](JacobianPoint point) { return duals(point).back(); };
  EXPECT_EQ(last(JacobianPoint::kStart).t, 0);
  EXPECT_EQ(last(JacobianPoint::kStart).u, 0.5);
  const Asked middle = last(JacobianPoint::kMiddle);
  EXPECT_NEAR(middle.t, h / 2, 1e-15);
  EXPECT_NEAR(middle.u, 0.5 + 2 * h / 2 + a0 * h * h / 8, 1e-14);
  // Radau IIA's stages lie at 0.155, 0.645 and 1: the second one is nearest to 0.6.
  const double c = (4 + std::sqrt(6.0)) / 10;
  const Asked predicted = last(JacobianPoint::kPredicted);
  EXPECT_NEAR(predicted.t, c * h, 1e-15);
  EXPECT_NEAR(predicted.u, 0.5 + 2 * c * h + a0 * c * c * h * h / 2, 1e-14);
  const auto each = duals(JacobianPoint::kEachStage);
  ASSERT_GE(each.size(), 3u);
  const double nodes[] = {(4 - std::sqrt(6.0)) / 10, c, 1};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(each[each.size() - 3 + i].t, nodes[i] * h, 1e-14);
}

// Checks k in the first residuals of the second step. (k = 0: the check that the residual has no memory.) In the first
// step the stages have k = c_i h, the end k = h.
TEST(PredictorOption, IsWhereNewtonStarts) {
  const double h = 0.25;
  const auto second = [&](Predictor predictor) {
    IntegratorOptions o = oneStep(h);
    o.predictor = predictor;
    std::vector<Asked> found;
    for (const auto& one : askedBy(o, 2 * h, "radau_iia_2")) {
      if (!one.dual && one.k != 0 && one.t > h * (1 + 1e-12)) found.push_back(one);
    }
    found.resize(2);  // the two stages of the first iteration
    return found;
  };
  // The last step is shorter: 0.4 of the previous one.
  IntegratorOptions o = oneStep(h);
  o.predictor = Predictor::kExtrapolated;
  int shorter = 0;
  for (const auto& one : askedBy(o, 1.4 * h, "radau_iia_2")) {
    if (one.dual || one.k == 0 || one.t <= h * (1 + 1e-12)) continue;
    EXPECT_NEAR(one.k, one.t, 1e-13) << "k = t is extrapolated exactly";
    ++shorter;
  }
  EXPECT_GE(shorter, 2);
  const double c[] = {1.0 / 3, 1};
  const auto previous = second(Predictor::kPrevious);
  const auto constant = second(Predictor::kAcceleration);
  const auto extrapolated = second(Predictor::kExtrapolated);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(previous[i].t, h + c[i] * h, 1e-15);
    EXPECT_NEAR(previous[i].k, c[i] * h, 1e-14) << "stage " << i;
    EXPECT_NEAR(constant[i].k, h, 1e-14) << "stage " << i;
    EXPECT_NEAR(extrapolated[i].k, h + c[i] * h, 1e-14) << "stage " << i;
  }
}

Linearization<double> termsOf(JacobianTerms terms, DerivativeSource source, double* second_d2) {
  const auto system = makeSystem<double>(Coupled{}, {Formulation::kIndex2});
  State<double> s(Coupled{}.sizes());
  s.u << 0.6, 0.8;
  s.v << 0.4, -0.3;
  s.x << 0.5;
  s.w << 2, -1, 0.35, 1.5;
  Linearization<double> D(Pattern::dense(4));
  Differentiator<double> differentiator(*system, source, terms);
  differentiator.evaluate(Level::kFormulated, pointOf(s), D);
  if (second_d2) {
    State<double> moved = s;
    moved.u << 0.8, 0.6;
    Linearization<double> again(Pattern::dense(4));
    differentiator.evaluate(Level::kFormulated, pointOf(moved), again);
    *second_d2 = again.dense2()(1, 0);
  }
  return D;
}

// Matrices derived by hand, rows (u0, u1, x, z): D0 by (a0, a1, k, z), D1 by (v0, v1, x, .), D2 by (u0, u1, ., .).
TEST(JacobianTermsOption, LeaveOutTheTermsThatTheirNamesSay) {
  const double m = 1 + 0.3 * 0.6 + 0.2 * 0.4 + 0.7 * 0.5 + 0.05 * 1.5, a = 2;
  for (const auto source : {DerivativeSource::kAutomatic, DerivativeSource::kCentral}) {
    const double tolerance = source == DerivativeSource::kAutomatic ? 1e-13 : 1e-8;
    for (const auto terms :
         {JacobianTerms::kFull, JacobianTerms::kNoMassVxz, JacobianTerms::kNoMass, JacobianTerms::kConstantStiffness}) {
      double later = 0;
      const auto D = termsOf(terms, source, &later);
      const bool vxz = terms == JacobianTerms::kNoMassVxz || terms == JacobianTerms::kNoMass;
      const bool u = terms == JacobianTerms::kNoMass;
      EXPECT_NEAR(D.dense0()(0, 0), -m, tolerance) << idOf(terms);
      EXPECT_NEAR(D.dense0()(0, 3), -0.6 - (vxz ? 0 : 0.05 * a), tolerance) << idOf(terms);
      EXPECT_NEAR(D.dense1()(0, 0), vxz ? 0 : -0.2 * a, tolerance) << idOf(terms);
      EXPECT_NEAR(D.dense1()(0, 1), 2, tolerance) << idOf(terms);
      EXPECT_NEAR(D.dense1()(0, 2), 1 - (vxz ? 0 : 0.7 * a), tolerance) << idOf(terms);
      EXPECT_NEAR(D.dense2()(0, 0), -1.5 - (u ? 0 : 0.3 * a), tolerance) << idOf(terms);
      EXPECT_NEAR(D.dense2()(0, 1), 3, tolerance) << idOf(terms);
      EXPECT_NEAR(D.dense2()(1, 0), 10 * 0.6, tolerance) << idOf(terms);
      // The constant stiffness is evaluated once and does not change with u.
      const double at = terms == JacobianTerms::kConstantStiffness ? 0.6 : 0.8;
      EXPECT_NEAR(later, 10 * at, 10 * tolerance) << idOf(terms);
      EXPECT_NEAR(D.dense2()(3, 0), 0.4, tolerance) << "d/du of u.v";
      EXPECT_NEAR(D.dense1()(3, 1), 0.8, tolerance) << "d/dv of u.v";
    }
  }
}

/// Algebraic unknowns in the rows of the constraints: z[1] in its own equation, and x.
struct Algebraic {
  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 2, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = p.z[0] - p.x[0] - p.k[0];
    r.z[0] = 3.0 * p.z[0] - p.x[0] + 0.5 * p.z[1];
    r.z[1] = 2.0 * p.z[1] - p.x[0] * p.x[0];
  }
};

TEST(JacobianTermsOption, NoConstraintXzDropsTheAlgebraicRows) {
  const auto system = makeSystem<double>(Algebraic{});
  const auto s = startOf(Algebraic{}, {.x = {0.5}});
  const auto of = [&](JacobianTerms terms) {
    Linearization<double> D(Pattern::dense(3));
    Differentiator<double>(*system, DerivativeSource::kAutomatic, terms).evaluate(Level::kFormulated, pointOf(s), D);
    return D;
  };
  const auto full = of(JacobianTerms::kFull), dropped = of(JacobianTerms::kNoConstraintXz);
  EXPECT_EQ(full.dense0()(1, 1), 3);
  EXPECT_EQ(full.dense0()(1, 2), 0.5);
  EXPECT_EQ(full.dense1()(1, 0), -1);
  EXPECT_EQ(full.dense1()(2, 0), -1);
  EXPECT_EQ(dropped.dense0()(0, 1), 1) << "the row of x keeps its z";
  EXPECT_EQ(dropped.dense1()(0, 0), -1);
  for (Index row = 1; row < 3; ++row) {
    EXPECT_EQ(dropped.dense0()(row, 1), 0);
    EXPECT_EQ(dropped.dense0()(row, 2), 0);
    EXPECT_EQ(dropped.dense1()(row, 0), 0);
  }
}

/// An oscillator whose mass depends strongly on u and v: Newton contracts more slowly if these terms are left out.
struct HeavyMass {
  Sizes sizes() const { return {.nu = 1, .nx = 1, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -50.0 * p.u[0] - (1.0 + 0.1 * p.v[0] * p.v[0]) * p.a[0];
    r.x[0] = p.u[0] - p.k[0];
  }
};

TEST(JacobianTermsOption, CostIterationsNotAccuracy) {
  const auto start = startOf(HeavyMass{}, {.u = {1}, .x = {0.5}});
  // With fixed steps Newton iterates to round-off, regardless of its matrix.
  const auto with = [&](JacobianTerms terms) {
    IntegratorOptions o = fixedSteps(0.01);
    o.newton.kind = NewtonKind::kSimplified;
    o.jacobian = terms;
    return taken(HeavyMass{}, start, 1, o).solution;
  };
  const auto full = with(JacobianTerms::kFull);
  ASSERT_EQ(full.outcome, Outcome::kSuccess);
  for (const auto terms : {JacobianTerms::kNoMassVxz, JacobianTerms::kNoMass}) {
    const auto less = with(terms);
    ASSERT_EQ(less.outcome, Outcome::kSuccess) << less.detail;
    EXPECT_GT(less.counters.newton_iterations, full.counters.newton_iterations) << idOf(terms);
    EXPECT_NEAR(less.state.u[0], full.state.u[0], 1e-11) << idOf(terms);
  }
}

}  // namespace
}  // namespace irk::test
