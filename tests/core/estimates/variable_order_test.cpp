#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/estimates/variable_order.h"
#include "irk/scene.h"
#include "tests/core/support.h"

namespace irk::test {
namespace {

template <class P>
Solution<double> variableRun(P problem, const State<double>& start, double t_end, const Methods<double>& methods,
                             const IntegratorOptions& options) {
  return Integrator<double>(makeSystem<double>(problem), methods, options).integrate(start, t_end);
}

TEST(VariableOrder, KeepsItsTolerance) {
  for (const double tol : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const auto s =
        variableRun(Riccati{}, riccatiStart<double>(), 10, makeMethods<double>("radau_iia_3", 13, 5), variable(tol));
    ASSERT_EQ(s.outcome, Outcome::kSuccess) << s.detail;
    EXPECT_LT(std::abs(s.state.x[0] - (1.5 + std::sin(10.0))), 20 * tol) << tol;
  }
}

TEST(VariableOrder, TakesFewerStepsThanALowOrderAtATightTolerance) {
  auto fixed = variable(1e-11);
  fixed.order = OrderControl::kFixed;
  const auto start = oscillatorsStart<double>();
  const auto low = variableRun(Oscillators{}, start, 10, makeTableau<double>("radau_iia_3"), fixed);
  const auto s = variableRun(Oscillators{}, start, 10, makeMethods<double>("radau_iia_3", 13, 5), variable(1e-11));
  ASSERT_EQ(low.outcome, Outcome::kSuccess);
  ASSERT_EQ(s.outcome, Outcome::kSuccess) << s.detail;
  EXPECT_LT(s.counters.steps_accepted, low.counters.steps_accepted / 5);
}

TEST(VariableOrder, OfOneMemberIsThatMethod) {
  auto fixed = variable(1e-8);
  fixed.order = OrderControl::kFixed;
  const auto start = oscillatorsStart<double>();
  const auto method = makeTableau<double>("radau_iia_5");
  const auto a = variableRun(Oscillators{}, start, 3, method, fixed);
  const auto b = variableRun(Oscillators{}, start, 3, Methods<double>({method}, 0), variable(1e-8));
  EXPECT_EQ(a.counters.steps_accepted, b.counters.steps_accepted);
  EXPECT_EQ(a.state.u, b.state.u);
}

TEST(VariableOrder, GoesThroughConstraintsAndIsReproducible) {
  const auto methods = makeMethods<double>("radau_iia_3", 13, 5);
  const auto a = variableRun(CartesianPendulum{}, pendulumStart<double>(), 3, methods, variable(1e-9));
  const auto b = variableRun(CartesianPendulum{}, pendulumStart<double>(), 3, methods, variable(1e-9));
  ASSERT_EQ(a.outcome, Outcome::kSuccess) << a.detail;
  EXPECT_EQ(a.state.u, b.state.u);
  EXPECT_EQ(a.state.w, b.state.w);
}

TEST(VariableOrder, AnIntegratorUsedAgainBeginsWithItsFirstMember) {
  for (const bool fixed : {false, true}) {
    auto options = variable(1e-10);
    if (fixed) options.order = OrderControl::kFixed;
    const auto methods =
        fixed ? Methods<double>(makeTableau<double>("radau_iia_3")) : makeMethods<double>("radau_iia_3", 13, 5);
    Integrator<double> integrator(makeSystem<double>(Oscillators{}), methods, options);
    const auto start = oscillatorsStart<double>();
    const auto first = integrator.integrate(start, 5);
    const auto second = integrator.integrate(start, 5);
    EXPECT_EQ(first.counters.steps_accepted, second.counters.steps_accepted);
    EXPECT_EQ(first.counters.newton_iterations, second.counters.newton_iterations);
    EXPECT_EQ(first.state.u, second.state.u);
  }
}

// Ten revolutions, started with three stages: the first few steps must not dominate the error. Before estimates were
// compared as in RADAU, the error was 300 times that of nine stages throughout.
TEST(VariableOrder, LowMembersErrAsLittleAsHighOnes) {
  const Scene<double> scene = makeScene<double>("kepler", {});
  const double revolutions = 20 * std::acos(-1.0);
  const auto error = [&](const Methods<double>& methods, OrderControl order) {
    IntegratorOptions o = variable(1e-8);
    o.order = order;
    const auto s = Integrator<double>(scene.system({}), methods, o).integrate(scene.start, revolutions);
    EXPECT_EQ(s.outcome, Outcome::kSuccess) << s.detail;
    return (s.state.u - scene.start.u).norm();
  };
  const double nine = error(Methods<double>(makeTableau<double>("radau_iia_9")), OrderControl::kFixed);
  const double from_three = error(makeMethods<double>("radau_iia_3", 13, 5), OrderControl::kVariable);
  EXPECT_LT(from_three, 20 * nine);
  EXPECT_LT(nine, 1e-8);
}

// For Robertson's problem, Newton's method fails seven times with the first step of HW's guess. That must not make
// the integration begin with fewer stages, which take half as many steps again.
TEST(VariableOrder, FailuresInTheFirstStepShortenItOnly) {
  const Scene<double> scene = makeScene<double>("robertson", {});
  const auto end = [&](const Methods<double>& methods, OrderControl order) {
    IntegratorOptions o = variable(1e-7);
    o.order = order;
    o.solver = StageSolverKind::kEigen;
    o.jacobian_point = JacobianPoint::kPredicted;
    o.newton.kind = NewtonKind::kBroyden;
    const auto s = Integrator<double>(scene.system({}), methods, o).integrate(scene.start, 10);
    EXPECT_EQ(s.outcome, Outcome::kSuccess) << s.detail;
    return s.counters;
  };
  const auto fixed = end(makeTableau<double>("radau_iia_7"), OrderControl::kFixed);
  const auto free = end(makeMethods<double>("radau_iia_7", 13, 7), OrderControl::kVariable);
  ASSERT_GE(fixed.steps_rejected_newton, 3);
  EXPECT_LE(3 * free.steps_accepted, 4 * fixed.steps_accepted);
}

// The motion rests until an input that nobody declares is switched on. At rest the lowest member is the cheapest one.
// Its strictness is 1e5 and more, and at the jump errors fall with h only.
TEST(VariableOrder, PassesAJumpOfTheRates) {
  for (const double tau : {1.0, 1e-2, 1e-3, 1e-5}) {
    const FirstOrder problem{
        [tau]<class T>(const Point<T>& p) { return ((p.t > T(0.3) ? T(1) : T(0)) - p.x[0]) / tau; }};
    for (const char* method : {"radau_iia_1", "radau_iia_3", "radau_iia_5", "lobatto_iiic_3"}) {
      for (const double tol : {1e-4, 1e-6, 1e-9}) {
        SCOPED_TRACE(std::string(method) + " tau " + std::to_string(tau) + " tol " + std::to_string(tol));
        const auto s =
            variableRun(problem, State<double>(problem.sizes()), 2, makeMethods<double>(method, 13, 3), variable(tol));
        ASSERT_EQ(s.outcome, Outcome::kSuccess) << s.detail;
        EXPECT_NEAR(s.state.x[0], 1 - std::exp(-1.7 / tau), 30 * tol);
      }
    }
  }
}

TEST(VariableOrder, RefusesOtherEstimatesAndFiles) {
  IntegratorOptions o = variable(1e-6);
  o.step.estimate = ErrorEstimate::kRichardson;
  EXPECT_THROW(Integrator<double>(makeSystem<double>(Riccati{}), makeMethods<double>("radau_iia_3", 13, 5), o), Misuse);
  EXPECT_THROW(makeMethods<double>(IRK_SOURCE_DIR "/tableaus/data/radau_iia_3.txt", 13, 5), Misuse);
}

TEST(VariableOrder, LadderOfAFamily) {
  const auto methods = makeMethods<double>("radau_iia_4", 9, 5);
  std::vector<Index> stages;
  for (const auto& tableau : methods.members()) stages.push_back(tableau.stages());
  EXPECT_EQ(stages, (std::vector<Index>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
  EXPECT_EQ(methods.members()[methods.start].stages(), 4);
}

// The process keeps them.
TEST(VariableOrder, LaddersAreNotMixedUp) {
  const auto ends = [](std::string_view id, Index most) {
    const auto methods = makeMethods<double>(id, most, 1);
    return methods.members().front().id + " to " + methods.members().back().id;
  };
  for (int twice = 0; twice < 2; ++twice) {
    EXPECT_EQ(ends("radau_ia", 13), "radau_ia_2 to radau_ia_13");
    EXPECT_EQ(ends("lobatto_iiic", 13), "lobatto_iiic_2 to lobatto_iiic_13");
    EXPECT_EQ(ends("radau_ia", 5), "radau_ia_2 to radau_ia_5");
    EXPECT_EQ(ends("radau_ia_1", 13), "radau_ia_1 to radau_ia_13");
  }
}

TEST(VariableOrder, AFamilyBeginsWithTheStagesAskedFor) {
  const auto startOf = [](std::string_view id, Index most, Index first) {
    const auto methods = makeMethods<double>(id, most, first);
    return methods.members()[methods.start].stages();
  };
  EXPECT_EQ(startOf("radau_iia", 13, 6), 6);
  EXPECT_EQ(startOf("radau_iia", 5, 9), 5) << "no more than max_stages";
  EXPECT_EQ(startOf("lobatto_iiic", 13, 1), 2) << "the smallest there is";
  EXPECT_EQ(startOf("radau_ia", 13, 1), 2) << "stage order 0 has no estimate";
  EXPECT_EQ(startOf("radau_iia_9", 5, 2), 9) << "a given member counts";
  EXPECT_THROW(makeMethods<double>("radau", 13, 5), Misuse);
  EXPECT_THROW(makeMethods<double>("radau_iia_x", 13, 5), Misuse);
}

TEST(VariableOrder, BeginsWithMoreStagesAtSmallerTolerances) {
  EXPECT_EQ(firstStages({1e-2, 1e-2, NormKind::kMixed}), 3);
  EXPECT_EQ(firstStages({1e-4, 1e-4, NormKind::kMixed}), 5);
  EXPECT_EQ(firstStages({1e-12, 1e-8, NormKind::kMixed}), 9) << "the larger of the two";
  EXPECT_EQ(firstStages({100, 1, NormKind::kMixed}), 3) << "2.5, to an odd number";
}

}  // namespace
}  // namespace irk::test
