// Errors of single steps, carried to the end by the motion.
#include "core/estimates/error_transport.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "core/estimates/accumulation.h"
#include "core/estimates/carried_error.h"
#include "core/system/counting.h"
#include "tests/core/support.h"

namespace irk::test {
namespace {

/// x' = rate (x - cos t) - sin t: x = cos t, from which other solutions depart as exp(rate t).
struct Departing {
  double rate;
  Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    r.x[0] = rate * (p.x[0] - cos(p.t)) - sin(p.t) - p.k[0];
  }
};

/// u'' = u v - sin(u) + cos t: nonlinear, not autonomous, of second order.
struct Driven {
  Sizes sizes() const { return {.nu = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    r.u[0] = p.u[0] * p.v[0] - sin(p.u[0]) + cos(p.t) - p.a[0];
  }
};

Solution<double> follow(double rate, const char* method, double tol, double t_end) {
  State<double> start(Departing{}.sizes());
  start.x[0] = 1;
  return integrate<double>(Departing{rate}, start, t_end, makeTableau<double>(method), adaptive(tol));
}
double errorIn(const Solution<double>& solution, double tol) {
  return std::abs(solution.state.x[0] - std::cos(solution.state.t)) / tol;
}

// One step of Driven, and the same step solved from another start.
struct TwoSteps {
  std::shared_ptr<const System<double>> system = makeSystem<double>(Driven{}, {});
  IntegratorOptions options = adaptive(1e-12);
  Scheme<double> scheme;
  Counters counters;
  CountingSystem<double> counted{*system, counters, 1};
  SharedJacobian<double> jacobian;
  ErrorNorm<double> norm;
  Stepper<double> stepper, other;
  State<double> from, to, start, end, solved;

  explicit TwoSteps(const char* method)
      : scheme(makeTableau<double>(method)),
        jacobian(counted, scheme, options, counters),
        norm(counted, options.tolerances, {}),
        stepper(counted, scheme, options, jacobian, norm, counters),
        other(counted, scheme, options, jacobian, norm, counters),
        from(system->sizes()),
        to(from),
        start(from),
        end(from),
        solved(from) {
    from.u[0] = 0.3;
    from.v[0] = -0.5;
    from.w[0] = accelerationOf(from);
    start = from;
    norm.update(from);
  }
  static double accelerationOf(const State<double>& s) { return s.u[0] * s.v[0] - std::sin(s.u[0]) + std::cos(s.t); }
};

class EndFrom : public testing::TestWithParam<const char*> {};

// The slower twin: the step solved again from the other start.
TEST_P(EndFrom, IsTheEndOfTheStepSolvedFromThere) {
  TwoSteps steps(GetParam());
  ASSERT_EQ(steps.stepper.attempt(steps.stepper.stages(), steps.from, 0.2, steps.to).outcome, Outcome::kSuccess);
  steps.start.u[0] += 1e-4;
  steps.start.v[0] -= 2e-4;
  steps.start.w[0] = TwoSteps::accelerationOf(steps.start);
  StepCorrection<double> scratch(1, steps.scheme.s);
  ASSERT_EQ(steps.stepper.endFrom(steps.start, steps.end, scratch), Outcome::kSuccess);
  ASSERT_EQ(steps.other.attempt(steps.other.stages(), steps.start, 0.2, steps.solved).outcome, Outcome::kSuccess);
  const double du = steps.solved.u[0] - steps.to.u[0], dv = steps.solved.v[0] - steps.to.v[0];
  ASSERT_GT(std::abs(du), 1e-5);
  EXPECT_NEAR(steps.end.u[0] - steps.to.u[0], du, 3e-3 * std::abs(du));
  EXPECT_NEAR(steps.end.v[0] - steps.to.v[0], dv, 3e-3 * std::abs(dv));
}
INSTANTIATE_TEST_SUITE_P(ErrorTransport, EndFrom,
                         testing::Values("radau_iia_2", "radau_iia_3", "gauss_4", "lobatto_iiia_3"));

// exp(25) = 7e10: whatever the steps' errors are, the end is far off. Each step keeps its tolerance.
TEST(ErrorTransport, SeesWhatTheMotionAmplifies) {
  for (const char* method : {"radau_iia_3", "gauss_2", "lobatto_iiia_3", "lobatto_iiic_3"}) {
    for (const double tol : {1e-4, 1e-8}) {
      const auto solution = follow(5, method, tol, 5);
      EXPECT_EQ(solution.outcome, Outcome::kInaccurate) << method << ", error " << errorIn(solution, tol);
      EXPECT_NE(solution.detail.find("the motion has multiplied them by"), std::string::npos) << solution.detail;
      EXPECT_GT(errorIn(solution, tol), 1000) << method;
    }
  }
}

// exp(3) = 20 and exp(-500): the ends are right.
TEST(ErrorTransport, LeavesRightRunsAlone) {
  for (const double rate : {3.0, -100.0}) {
    for (const char* method : {"radau_iia_3", "gauss_2", "lobatto_iiia_3", "lobatto_iiic_3"}) {
      const auto solution = follow(rate, method, 1e-6, rate > 0 ? 1 : 5);
      EXPECT_EQ(solution.outcome, Outcome::kSuccess) << method << ", rate " << rate << ": " << solution.detail;
      EXPECT_LT(errorIn(solution, 1e-6), 200) << method << ", rate " << rate;
    }
  }
}

// A success is right to 1000 tolerances and 1e-9; an estimate of half of that is doubted.
TEST(ErrorTransport, DoubtsFromHalfOfWhatASuccessMayHave) {
  for (const double tol : {1e-4, 1e-10}) {
    const double limit = 500 + 0.5e-9 / tol;
    EXPECT_EQ((CarriedError{0.99 * limit, 2}.doubt({tol, tol})), "") << tol;
    EXPECT_NE((CarriedError{1.01 * limit, 2}.doubt({tol, tol})), "") << tol;
  }
  EXPECT_EQ(CarriedError{}.doubt({1e-4, 1e-4}), "");
}

TEST(ErrorTransport, IsNotUsedWhereStepsGrowFarInTheLeftHalfPlane) {
  EXPECT_TRUE(isStableAtInfinity(Scheme<double>(makeTableau<double>("gauss_3"))));
  EXPECT_TRUE(isStableAtInfinity(Scheme<double>(makeTableau<double>("lobatto_iiia_4"))));
  EXPECT_TRUE(isStableAtInfinity(Scheme<double>(makeTableau<double>("lobatto_iiib_3"))));
  EXPECT_TRUE(isStableAtInfinity(Scheme<double>(makeTableau<double>("radau_ia_3"))));
  EXPECT_FALSE(isStableAtInfinity(Scheme<double>(makeTableau<double>("lobatto_iiics_3"))));
}

}  // namespace
}  // namespace irk::test
