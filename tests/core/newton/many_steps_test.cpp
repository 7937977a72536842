// The errors that Newton's method leaves in very many steps must not add up.
#include <gtest/gtest.h>

#include <utility>

#include "core/newton/newton_base.h"
#include "irk/scene.h"
#include "tests/core/support.h"

namespace irk::test {
namespace {

IntegratorOptions tight(double tolerance, ErrorEstimate estimate) {
  IntegratorOptions options = adaptive(tolerance);
  options.step.estimate = estimate;
  return options;
}

TEST(ManySteps, KappaFallsWithTheNumberOfSteps) {
  const IncrementLimit limit = incrementLimit<double>(tight(1e-6, ErrorEstimate::kEmbedded));
  EXPECT_DOUBLE_EQ(limit.kappa, 0.01);
  EXPECT_EQ(limit.after(0, false), limit.kappa);
  EXPECT_EQ(limit.after(1000, false), limit.kappa);
  EXPECT_DOUBLE_EQ(limit.after(1'000'000, false), 1e-5);
  // The sum over all steps if each error had its largest size and all had the same sign.
  double sum = 0;
  for (int n = 0; n < 1'000'000; ++n) sum += limit.after(n, false);
  EXPECT_LT(sum, 100);
  // Not below round-off: 10 eps / tol.
  EXPECT_DOUBLE_EQ(limit.after(std::int64_t{1} << 60, false), 10 * 2.220446049250313e-16 / 1e-6);
}

// The difference of a step and its halves is divided by 2^q - 1, and with it what Newton's method has left in them.
TEST(ManySteps, KappaIsSmallerWhereTheEstimateHidesNewtonsRest) {
  const auto kappa = [](ErrorEstimate estimate) { return incrementLimit<double>(tight(1e-6, estimate)).kappa; };
  EXPECT_DOUBLE_EQ(kappa(ErrorEstimate::kEmbedded), 1e-2);
  EXPECT_DOUBLE_EQ(kappa(ErrorEstimate::kRichardson), 1e-3);
  EXPECT_DOUBLE_EQ(kappa(ErrorEstimate::kDoubling), 1e-2) << "the paper's stays";
}

TEST(ManySteps, KappaIsSmallerInIndex3) {
  const IncrementLimit limit = incrementLimit<double>(tight(1e-6, ErrorEstimate::kEmbedded));
  EXPECT_DOUBLE_EQ(limit.after(0, true), 1e-3);
  EXPECT_DOUBLE_EQ(limit.after(1'000'000, true), 1e-6);
  const IncrementLimit at_round_off = incrementLimit<double>(tight(1e-13, ErrorEstimate::kEmbedded));
  EXPECT_EQ(at_round_off.after(0, true), at_round_off.least);
}

TEST(ManySteps, TheCallersKappaStays) {
  IntegratorOptions options = tight(1e-6, ErrorEstimate::kEmbedded);
  options.newton.kappa = 0.1;
  const IncrementLimit limit = incrementLimit<double>(options);
  EXPECT_EQ(limit.after(0, false), 0.1);
  EXPECT_EQ(limit.after(0, true), 0.1);
  EXPECT_EQ(limit.after(1'000'000, false), 0.1);
}

struct Ended {
  Scene<double> scene;
  Solution<double> solution;
};

Ended ended(const char* id, const char* method, Formulation formulation, const IntegratorOptions& options) {
  auto scene = makeScene<double>(id);
  Integrator<double> integrator(scene.system({.formulation = formulation}), makeTableau<double>(method), options,
                                scene.scale);
  auto solution = integrator.integrate(scene.start, scene.t_end);
  return {std::move(scene), std::move(solution)};
}

// Many steps; with one kappa for all of them the end was off by 2500 tolerances.
TEST(ManySteps, OfAMethodOfOrderTwoOnThePendulumKeepTheTolerance) {
  const auto options = tight(1e-6, ErrorEstimate::kEmbedded);
  const Ended lobatto = ended("pendulum", "lobatto_iiid_2", Formulation::kIndex2Projected, options);
  const Ended radau = ended("pendulum", "radau_iia_5", Formulation::kIndex2, tight(1e-10, ErrorEstimate::kRichardson));
  ASSERT_EQ(lobatto.solution.outcome, Outcome::kSuccess) << lobatto.solution.detail;
  ASSERT_EQ(radau.solution.outcome, Outcome::kSuccess) << radau.solution.detail;
  EXPECT_GT(lobatto.solution.counters.steps_accepted, 10'000);
  EXPECT_LT((lobatto.solution.state.u - radau.solution.state.u).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LT((lobatto.solution.state.v - radau.solution.state.v).cwiseAbs().maxCoeff(), 1e-4);
}

// A top that spins at 358 rad/s and multiplies errors by 450. Newton's method contracts slowly, and one increment that
// does not contract is not yet round-off: steps that ended there left 2.6e-9 in the end, 2600 tolerances.
TEST(ManySteps, DoNotEndAtOneSlowIncrement) {
  const Settings settings = {{"J1", "0.112"}, {"J3", "0.719"},         {"g", "29.3"},  {"l", "2.51"},
                             {"m", "34.6"},   {"precession", "-1.72"}, {"spin", "358"}};
  const auto scene = makeScene<double>("heavy_top", settings);
  const auto end = [&](const Methods<double>& methods, NewtonKind newton, OrderControl order, double h_max) {
    IntegratorOptions options = tight(1e-12, ErrorEstimate::kEmbedded);
    options.newton.kind = newton;
    options.order = order;
    options.jacobian_point = JacobianPoint::kPredicted;
    options.step.h_max = h_max;
    Integrator<double> integrator(scene.system({.formulation = Formulation::kIndex2Projected}), methods, options,
                                  scene.scale);
    return integrator.integrate(scene.start, scene.t_end);
  };
  const auto fast = end(makeMethods<double>("radau_iia", 13, 9), NewtonKind::kBroyden, OrderControl::kVariable, 1e300);
  const auto careful = end(makeTableau<double>("radau_iia_7"), NewtonKind::kSimplified, OrderControl::kFixed, 1e-3);
  ASSERT_EQ(fast.outcome, Outcome::kSuccess) << fast.detail;
  ASSERT_EQ(careful.outcome, Outcome::kSuccess) << careful.detail;
  EXPECT_LT((fast.state.u - careful.state.u).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((fast.state.v - careful.state.v).cwiseAbs().maxCoeff(), 1e-9 * 200);
}

}  // namespace
}  // namespace irk::test
