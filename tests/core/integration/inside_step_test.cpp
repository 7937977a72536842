// The solution inside the steps, as a user asks for it, against exact solutions.
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/core/support.h"

namespace irk::test {
namespace {

/// u'' = sin(phi) - sin(u) + u' phi' - phi'^2 + phi'' and x' as in Riccati, both with the solution phi = 1.5 + sin t.
struct Both {
  Sizes sizes() const { return {.nu = 1, .nx = 1, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    const T phi = 1.5 + sin(p.t), rate = cos(p.t);
    r.u[0] = sin(phi) - sin(p.u[0]) + p.v[0] * rate - rate * rate - sin(p.t) - p.a[0];
    r.x[0] = phi * phi - p.x[0] * p.x[0] + rate - p.k[0];
  }
};

State<double> bothStart() { return startOf(Both{}, {.u = {1.5}, .v = {1}, .x = {1.5}}); }

// The largest errors of u, v, x, k at 0.3 of all steps of size h.
std::vector<double> errorsInside(const std::string& method, double h) {
  Integrator<double> integrator(makeSystem<double>(Both{}), makeTableau<double>(method), fixedSteps(h));
  std::vector<double> most(4);
  Monitor<double> monitor;
  monitor.inside = true;
  monitor.accepted = [&](const StepRecord<double>& step) {
    const double t = step.t - 0.7 * step.h;
    const State<double> at = step.inside->at(t);
    EXPECT_DOUBLE_EQ(at.t, t);
    const auto keep = [](double& error, double value, double exact) {
      error = std::max(error, std::abs(value - exact));
    };
    keep(most[0], at.u[0], 1.5 + std::sin(t));
    keep(most[1], at.v[0], std::cos(t));
    keep(most[2], at.x[0], 1.5 + std::sin(t));
    keep(most[3], at.k()[0], std::cos(t));
  };
  const auto solution = integrator.integrate(bothStart(), 2.0, monitor);
  EXPECT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
  return most;
}

// The errors by component are those whose norm the step has, and only the embedded estimate has them.
TEST(StepRecord, HasTheErrorsOfItsNorm) {
  for (const ErrorEstimate estimate : {ErrorEstimate::kEmbedded, ErrorEstimate::kRichardson}) {
    IntegratorOptions options;
    options.tolerances.rtol = options.tolerances.atol = 1e-5;
    options.step.estimate = estimate;
    options.guards = Guards::kNone;
    Integrator<double> integrator(makeSystem<double>(Both{}), makeTableau<double>("radau_iia_3"), options);
    Monitor<double> monitor;
    State<double> before = bothStart();
    int steps = 0;
    monitor.accepted = [&](const StepRecord<double>& step) {
      ++steps;
      EXPECT_EQ(step.errors != nullptr, estimate == ErrorEstimate::kEmbedded);
      if (!step.errors) return;
      const auto part = [](double error, double y) { return error / (1e-5 + 1e-5 * std::abs(y)); };
      const State<double>& e = *step.errors;
      const double norm = std::hypot(part(e.u[0], before.u[0]), part(e.v[0], before.v[0]), part(e.x[0], before.x[0]));
      EXPECT_NEAR(norm / std::sqrt(3), step.error, 1e-12 * norm);
      before = step.state;
    };
    EXPECT_EQ(integrator.integrate(bothStart(), 2.0, monitor).outcome, Outcome::kSuccess);
    EXPECT_GT(steps, 3);
  }
}

// For collocation methods: x, v of order s + 1, u of s + 2, k of s, and none of more than p.
TEST(InsideStep, HasTheOrderThatIsDocumented) {
  struct Case {
    const char* method;
    double u, x, k;
  };
  for (const Case& c : {Case{"radau_iia_3", 5, 4, 3}, Case{"gauss_3", 5, 4, 3}, Case{"gauss_2", 4, 3, 2},
                        Case{"radau_iia_1", 1, 1, 1}, Case{"lobatto_iiia_4", 6, 5, 4}}) {
    SCOPED_TRACE(c.method);
    const auto orders = ordersOf({2.0 / 20, 2.0 / 28, 2.0 / 40}, [&](double h) { return errorsInside(c.method, h); });
    EXPECT_NEAR(orders[0], c.u, 0.4);
    EXPECT_NEAR(orders[1], c.x, 0.3) << "of v";
    EXPECT_NEAR(orders[2], c.x, 0.3);
    EXPECT_NEAR(orders[3], c.k, 0.3);
  }
}

/// x' = cos t up to t = 0.7, then x' = -x^2; x(0) = 0.
struct Broken : SwitchesOnceAt {
  Broken() : SwitchesOnceAt(0.7) {}
  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    r.x[0] = (p.d[0] > T(0.5) ? T(-p.x[0] * p.x[0]) : T(cos(p.t))) - p.k[0];
  }
  static double exact(double t) { return t < 0.7 ? std::sin(t) : 1 / (1 / std::sin(0.7) + t - 0.7); }
};

// Each value inside the steps against `exact`, and the ends against the states of the steps.
template <class P, class Exact>
void expectInside(const P& problem, const State<double>& start, const IntegratorOptions& options, const Exact& exact) {
  Integrator<double> integrator(makeSystem<double>(problem), makeTableau<double>("radau_iia_5"), options);
  Monitor<double> monitor;
  State<double> last = start;
  int steps = 0;
  monitor.inside = true;
  monitor.accepted = [&](const StepRecord<double>& step) {
    ASSERT_NE(step.inside, nullptr);
    ++steps;
    const double t0 = last.t, h = step.t - t0;
    for (int i = 1; i < 20; ++i) {
      const double t = t0 + i * h / 20;
      EXPECT_NEAR(step.inside->at(t).x[0], exact(t), 1e-7) << "in the step from " << t0 << " to " << step.t;
    }
    EXPECT_EQ(step.inside->at(t0).x, last.x);
    EXPECT_EQ(step.inside->at(step.t).x, step.state.x);
    EXPECT_EQ(step.inside->at(step.t + 1).x, step.state.x);
    EXPECT_NEAR(step.inside->at(t0 + 1e-12 * h).x[0], last.x[0], 1e-11);
    EXPECT_NEAR(step.inside->at(step.t - 1e-12 * h).x[0], step.state.x[0], 1e-11);
    last = step.state;
  };
  const auto solution = integrator.integrate(start, 2.0, monitor);
  EXPECT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
  EXPECT_GT(steps, 2);
  EXPECT_DOUBLE_EQ(last.t, 2);
}

// A step of doubling is two halves, kept for a system without switches, too; each estimate has pieces of its own.
TEST(InsideStep, FollowsTheSolutionWithEachEstimate) {
  for (const ErrorEstimate estimate : {ErrorEstimate::kRichardson, ErrorEstimate::kEmbedded}) {
    IntegratorOptions options = adaptive(1e-9);
    options.step.estimate = estimate;
    expectInside(Riccati{}, riccatiStart<double>(), options, [](double t) { return 1.5 + std::sin(t); });
  }
}

// The step to the switch is a shorter one than was tried first.
TEST(InsideStep, FollowsTheSolutionUpToALocatedSwitch) {
  IntegratorOptions options = adaptive(1e-9);
  options.step.h = 0.3;
  expectInside(Broken{}, State<double>(Broken{}.sizes()), options, Broken::exact);
  expectInside(Broken{}, State<double>(Broken{}.sizes()), fixedSteps(0.11), Broken::exact);
}

// In GGL and first order, the unknowns of the steps are others than those of the scene.
TEST(InsideStep, IsInTheUnknownsOfTheScene) {
  for (const Formulation formulation : {Formulation::kIndex2, Formulation::kGgl}) {
    Integrator<double> integrator(makeSystem<double>(CartesianPendulum{}, {formulation}),
                                  makeTableau<double>("radau_iia_5"), adaptive(1e-9));
    Monitor<double> monitor;
    monitor.inside = true;
    monitor.accepted = [&](const StepRecord<double>& step) {
      const State<double> at = step.inside->at(step.t - 0.4 * step.h);
      ASSERT_EQ(at.u.size(), 2);
      ASSERT_EQ(at.z().size(), 1);
      EXPECT_NEAR(at.u.squaredNorm(), 1, 1e-6);
      EXPECT_NEAR(at.v.squaredNorm() / 2 + 9.81 * at.u[1], 0, 1e-5);
      EXPECT_NEAR(at.z()[0], at.v.squaredNorm() - 9.81 * at.u[1], 1e-3);
    };
    const auto solution = integrator.integrate(pendulumStart<double>(), 1.0, monitor);
    EXPECT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
  }
}

TEST(InsideStep, ChangesNoNumbersAndIsNotThereUnasked) {
  std::vector<double> ends;
  for (const bool inside : {false, true}) {
    Integrator<double> integrator(makeSystem<double>(Oscillators{}), makeTableau<double>("radau_iia_3"),
                                  adaptive(1e-6));
    Monitor<double> monitor;
    monitor.inside = inside;
    monitor.accepted = [&](const StepRecord<double>& step) {
      EXPECT_EQ(step.inside != nullptr, inside);
      if (inside) static_cast<void>(step.inside->at(step.t - step.h / 3));
    };
    ends.push_back(integrator.integrate(oscillatorsStart<double>(), 3.0, monitor).state.u[0]);
  }
  EXPECT_EQ(ends[0], ends[1]);
}

// Two stages at one time: no polynomial goes through them.
TEST(InsideStep, IsNotThereWhereStagesHaveOneTime) {
  Tableau<double> twice = makeTableau<double>("radau_iia_1");
  twice.id = "euler_twice";
  twice.A = Mat<double>::Zero(2, 2);
  twice.A << 1, 0, 0, 1;
  twice.b = Vec<double>::Constant(2, 0.5);
  twice.c = Vec<double>::Ones(2);
  Integrator<double> integrator(makeSystem<double>(Riccati{}), twice, fixedSteps(0.1));
  Monitor<double> monitor;
  monitor.inside = true;
  monitor.accepted = [](const StepRecord<double>& step) { EXPECT_EQ(step.inside, nullptr); };
  const auto solution = integrator.integrate(riccatiStart<double>(), 1.0, monitor);
  EXPECT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
}

}  // namespace
}  // namespace irk::test
