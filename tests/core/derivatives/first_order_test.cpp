// The first-order form with M factorized at every point, and once per step.
#include "core/derivatives/first_order.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/core/support.h"

namespace irk::test {
namespace {

struct FirstOrderRun {
  Solution<double> solution;
  std::int64_t factorizations;
};

// The first-order form starts from the problem's own state.
template <class P>
FirstOrderRun firstOrderRun(const P& problem, const State<double>& start, Formulation formulation,
                            const IntegratorOptions& o) {
  const auto system = makeSystem<double>(problem, {formulation});
  Integrator<double> integrator(system, makeTableau<double>("radau_iia_3"), o);
  auto solution = integrator.integrate(start, 1);
  EXPECT_EQ(solution.outcome, Outcome::kSuccess) << idOf(formulation) << solution.detail;
  const auto* form = dynamic_cast<const FirstOrderForm<double>*>(system.get());
  return {std::move(solution), form ? form->massFactorizations() : -1};
}

// Twenty steps: each has one new matrix, at the Jacobian's point or at its first stage. A step for which refinement
// does not converge would have more.
TEST(FirstOrder, FactorizesOncePerStep) {
  for (const auto source : {DerivativeSource::kAutomatic, DerivativeSource::kCentral}) {
    IntegratorOptions o = fixedSteps(0.05);
    o.derivatives = source;
    const auto point = firstOrderRun(Oscillators{}, oscillatorsStart<double>(), Formulation::kFirstOrder, o);
    const auto step = firstOrderRun(Oscillators{}, oscillatorsStart<double>(), Formulation::kFirstOrderPerStep, o);
    EXPECT_EQ(step.solution.counters.steps_accepted, 20);
    EXPECT_GT(point.factorizations, 3 * 20) << "at every stage of every iteration";
    EXPECT_GE(step.factorizations, 20) << idOf(source);
    EXPECT_LE(step.factorizations, 20 + step.solution.counters.jacobians) << idOf(source);
    EXPECT_LT((step.solution.state.u - point.solution.state.u).norm(), 1e-11) << idOf(source);
    EXPECT_LT((step.solution.state.v - point.solution.state.v).norm(), 1e-10) << idOf(source);
  }
}

// The K-form factorizes D0 alone at the start and for the multipliers of the end, which do not count. A projection does
// so in every step, a first-order form at every point.
TEST(MassFactorizations, AreCountedWhereTheyAreMade) {
  const auto count = [](Formulation formulation) {
    const auto s = integrate<double>(CartesianPendulum{}, pendulumStart<double>(), 1,
                                     makeTableau<double>("radau_iia_3"), fixedSteps(0.05), formulation);
    EXPECT_EQ(s.outcome, Outcome::kSuccess) << idOf(formulation) << s.detail;
    EXPECT_EQ(s.counters.steps_accepted, 20);
    return s.counters.mass_factorizations;
  };
  EXPECT_EQ(count(Formulation::kIndex2), 0);
  EXPECT_EQ(count(Formulation::kIndex3), 0);
  EXPECT_EQ(count(Formulation::kIndex2Projected), 20);
  EXPECT_GT(count(Formulation::kFirstOrder), 3 * 20);
  const auto point =
      firstOrderRun(Oscillators{}, oscillatorsStart<double>(), Formulation::kFirstOrderPerStep, fixedSteps(0.05));
  EXPECT_EQ(point.solution.counters.mass_factorizations, point.factorizations);
}

// Refined solves are as exact as those with factors of their own, also over long steps.
TEST(FirstOrder, RefinesToRoundOff) {
  const auto point =
      firstOrderRun(Oscillators{}, oscillatorsStart<double>(), Formulation::kFirstOrder, adaptive(1e-11));
  const auto step =
      firstOrderRun(Oscillators{}, oscillatorsStart<double>(), Formulation::kFirstOrderPerStep, adaptive(1e-11));
  EXPECT_LT((step.solution.state.u - point.solution.state.u).norm(), 1e-10);
  EXPECT_LT(step.factorizations, point.factorizations);
  const auto coarse =
      firstOrderRun(Oscillators{}, oscillatorsStart<double>(), Formulation::kFirstOrderPerStep, adaptive(1e-3));
  EXPECT_LT((coarse.solution.state.u - point.solution.state.u).norm(), 1e-2);
}

/// Two masses on springs, coupled by a third one: M is constant, but not diagonal.
struct Springs {
  Sizes sizes() const { return {.nu = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -2.0 * p.a[0] - p.a[1] - 3.0 * p.u[0] + p.u[1];
    r.u[1] = -p.a[0] - 2.0 * p.a[1] + p.u[0] - 3.0 * p.u[1] * p.u[1] * p.u[1];
  }
};

// A constant M is factorized before the start in both forms.
TEST(FirstOrder, LeavesAConstantMassAlone) {
  const auto start = startOf(Springs{}, {.u = {1, 0.5}});
  for (const auto formulation : {Formulation::kFirstOrder, Formulation::kFirstOrderPerStep}) {
    EXPECT_EQ(firstOrderRun(Springs{}, start, formulation, adaptive(1e-6)).factorizations, 0) << idOf(formulation);
  }
}

/// Masses in a row, coupled by springs and by inertia: M is tridiagonal, depends on u with `bends`, and the residual is
/// not linear in a with `hardens`.
struct SpringChain {
  Index n;
  double coupling = 0.5, bends = 0, hardens = 0;

  Sizes sizes() const { return {.nu = n}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    for (Index i = 0; i < n; ++i) {
      const T& u = p.u[i];
      T row = (2 + bends * u * u) * p.a[i] + hardens * p.a[i] * p.a[i] * p.a[i] + 3.0 * u + 0.1 * p.v[i];
      for (const Index j : {i - 1, i + 1}) {
        if (j >= 0 && j < n) row += coupling * p.a[j] - u * p.u[j];
      }
      r.u[i] = -row;
    }
  }
};

// Enough unknowns for a sparse D0. f is right if it solves the residual, its derivatives if they are difference
// quotients of f.
TEST(FirstOrder, SolvesSparseSystems) {
  constexpr Index n = 40;
  for (const SpringChain& chain :
       {SpringChain{n, 0}, SpringChain{n}, SpringChain{n, 0.5, 0.7}, SpringChain{n, 0.5, 0.7, 0.3}}) {
    SCOPED_TRACE(std::to_string(chain.coupling) + " " + std::to_string(chain.bends) + " " +
                 std::to_string(chain.hardens));
    const auto inner = makeSystem<double>(chain);
    const FirstOrderForm<double> form(inner);
    State<double> start(inner->sizes());
    for (Index i = 0; i < n; ++i) start.u[i] = std::sin(1.0 + static_cast<double>(i)), start.v[i] = 0.3;
    State<double> state = form.fromScene(start);
    const auto f = [&](const Vec<double>& x) {
      state.x = x;
      state.w.setZero();
      Vec<double> r(2 * n);
      form.evaluate(Level::kFormulated, pointOf(state), {r.data(), r.size()});
      return r;
    };
    Vec<double> x = state.x;
    for (Index i = 0; i < 2 * n; ++i) x[i] += 0.1 * std::cos(static_cast<double>(i));
    const Vec<double> value = f(x);
    State<double> scene(inner->sizes());
    scene.u = x.head(n);
    scene.v = x.tail(n);
    scene.w = value.tail(n);
    Vec<double> r(n);
    inner->evaluate(Level::kAcceleration, pointOf(scene), {r.data(), r.size()});
    EXPECT_LT(r.lpNorm<Eigen::Infinity>(), 1e-13);
    EXPECT_EQ(value.head(n), x.tail(n));

    State<Dual<double>> dual(form.sizes());
    const Vec<double> direction = Vec<double>::Random(2 * n);
    for (Index i = 0; i < 2 * n; ++i) {
      dual.x[i] = Dual<double>(x[i]);
      dual.x[i].d[0] = direction[i];
      dual.w[i] = Dual<double>(0.0);
    }
    Vec<Dual<double>> derivative(2 * n);
    form.evaluate(Level::kFormulated, pointOf(dual), {derivative.data(), derivative.size()});
    constexpr double h = 1e-5;
    const Vec<double> quotient = (f(x + h * direction) - f(x - h * direction)) / (2 * h);
    for (Index i = 0; i < 2 * n; ++i) EXPECT_NEAR(derivative[i].d[0], quotient[i], 1e-8) << i;
    EXPECT_EQ(form.massFactorizations() > 0, chain.bends != 0);
  }
}

// A dense matrix would take 20 GB.
TEST(FirstOrder, LargeSystemsNeedNoDenseMatrix) {
  const SpringChain chain{50000};
  const FirstOrderForm<double> form(makeSystem<double>(chain));
  State<double> start(chain.sizes());
  start.u.setConstant(0.2);
  State<double> state = form.fromScene(start);
  state.w.setZero();
  Vec<double> r(state.x.size());
  form.evaluate(Level::kFormulated, pointOf(state), {r.data(), r.size()});
  // In the middle of the chain neighbours move alike: 3 a + 3 u - 2 u^2 = 0.
  EXPECT_NEAR(r[75000], (2 * 0.04 - 3 * 0.2) / 3, 1e-12);
}

}  // namespace
}  // namespace irk::test
