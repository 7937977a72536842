// The first-order form with M factorized at every point, and once per step.
#include "core/system/first_order.h"

#include <gtest/gtest.h>

#include "tests/core/support.h"

namespace irk::test {
namespace {

struct FirstOrderRun {
  Solution<double> solution;
  std::int64_t factorizations;
};

// The first-order form starts from the problem's own state.
template <class P>
FirstOrderRun run(const P& problem, const State<double>& start, Formulation formulation, const IntegratorOptions& o) {
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
    const auto point = run(Oscillators{}, oscillatorsStart<double>(), Formulation::kFirstOrder, o);
    const auto step = run(Oscillators{}, oscillatorsStart<double>(), Formulation::kFirstOrderPerStep, o);
    EXPECT_EQ(step.solution.counters.steps_accepted, 20);
    EXPECT_GT(point.factorizations, 3 * 20) << "at every stage of every iteration";
    EXPECT_GE(step.factorizations, 20) << idOf(source);
    EXPECT_LE(step.factorizations, 20 + step.solution.counters.jacobians) << idOf(source);
    EXPECT_LT((step.solution.state.u - point.solution.state.u).norm(), 1e-11) << idOf(source);
    EXPECT_LT((step.solution.state.v - point.solution.state.v).norm(), 1e-10) << idOf(source);
  }
}

// Refined solves are as exact as those with factors of their own, also over long steps.
TEST(FirstOrder, RefinesToRoundOff) {
  const auto point = run(Oscillators{}, oscillatorsStart<double>(), Formulation::kFirstOrder, adaptive(1e-11));
  const auto step = run(Oscillators{}, oscillatorsStart<double>(), Formulation::kFirstOrderPerStep, adaptive(1e-11));
  EXPECT_LT((step.solution.state.u - point.solution.state.u).norm(), 1e-10);
  EXPECT_LT(step.factorizations, point.factorizations);
  const auto coarse = run(Oscillators{}, oscillatorsStart<double>(), Formulation::kFirstOrderPerStep, adaptive(1e-3));
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

// A constant M is factorized before the start, whatever is asked for.
TEST(FirstOrder, LeavesAConstantMassAlone) {
  State<double> start(Springs{}.sizes());
  start.u << 1, 0.5;
  for (const auto formulation : {Formulation::kFirstOrder, Formulation::kFirstOrderPerStep}) {
    EXPECT_EQ(run(Springs{}, start, formulation, adaptive(1e-6)).factorizations, 0) << idOf(formulation);
  }
}

}  // namespace
}  // namespace irk::test
