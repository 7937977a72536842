// Systems whose steps ask for another mode: System::completeStep.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "core/system/reversed.h"
#include "tests/core/support.h"
#include "tests/refusal.h"

namespace irk::test {
namespace {

/// An angle phi with phi' = 1 by the coordinate s = tan((phi - c pi) / 2) of the chart c: s' = (1 + s^2) / 2, which is
/// infinite where phi is c pi + pi. A step that ends with |s| > 1 asks for the next chart. x_1 counts by itself.
struct Charts {
  bool has_switch = false;
  Sizes sizes() const { return {.nx = 2, .discrete = has_switch ? 2 : 1, .switches = has_switch ? 1 : 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = (1.0 + p.x[0] * p.x[0]) / 2.0 - p.k[0];
    r.x[1] = p.d[0] - p.k[1];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    if (has_switch) g[0] = p.d[1] > T(0.0) ? T(-1.0) : T(p.t - 9.0);
  }
  template <class T>
  void onSwitch(Index, const Point<T>&, T* d) const {
    d[1] = T(1.0);
  }
  std::string switchName(Index) const { return "nine"; }
  template <class T>
  bool completeStep(const Point<T>& p, T*, T*, T* x, T* d) const {
    if (!(p.x[0] > T(1.0))) return false;
    x[0] = -1.0 / p.x[0];
    d[0] = p.d[0] + 1.0;
    return true;
  }
};

struct SeenCharts {
  Solution<double> solution;
  std::vector<double> modes;  // at the switches
};

SeenCharts charts(Formulation formulation, const IntegratorOptions& options) {
  Integrator<double> integrator(makeSystem<double>(Charts{}, {formulation}), makeTableau<double>("radau_iia_3"),
                                options);
  SeenCharts seen;
  Monitor<double> monitor;
  monitor.switched = [&](const SwitchRecord<double>& at) {
    EXPECT_EQ(at.index, -1);
    EXPECT_EQ(at.name, "step");
    EXPECT_LE(std::abs(at.state.x[0]), 1);
    seen.modes.push_back(at.state.d[0]);
  };
  seen.solution = integrator.integrate(State<double>(Charts{}.sizes()), 10, monitor);
  return seen;
}

TEST(CompletedSteps, MayAskForAnotherMode) {
  for (const auto formulation : {Formulation::kIndex2, Formulation::kFirstOrder}) {
    const SeenCharts seen = charts(formulation, adaptive(1e-9));
    ASSERT_EQ(seen.solution.outcome, Outcome::kSuccess) << idOf(formulation) << seen.solution.detail;
    EXPECT_EQ(seen.modes, (std::vector<double>{1, 2, 3})) << idOf(formulation);
    EXPECT_EQ(seen.solution.counters.switches, 3);
    EXPECT_EQ(seen.solution.detail, "") << "a coordinate that jumps below zero is no amount";
    EXPECT_EQ(seen.solution.counters.located_events, 0);
    EXPECT_NEAR(seen.solution.state.x[0], std::tan((10 - 3 * std::numbers::pi) / 2), 1e-8) << idOf(formulation);
  }
}

// They are no switches that a run can stop at.
TEST(CompletedSteps, AreNotCountedAsTheSwitchOfStopAt) {
  IntegratorOptions options;
  options.stop_at = "nine";
  Integrator<double> integrator(makeSystem<double>(Charts{true}), makeTableau<double>("radau_iia_3"), options);
  const auto end = integrator.integrate(State<double>(Charts{true}.sizes()), 10);
  ASSERT_EQ(end.outcome, Outcome::kSuccess) << end.detail;
  EXPECT_NEAR(end.state.t, 9, 1e-8);
  EXPECT_EQ(end.state.d[0], 3);
}

struct WithoutMode {
  Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = 1.0 - p.k[0];
  }
  bool completesSteps() const { return true; }
};

TEST(CompletedSteps, AreRefusedBackwardInTime) {
  const auto message = refusal([] { const ReversedSystem<double> system(makeSystem<double>(WithoutMode{})); });
  EXPECT_TRUE(contains(message, "completeStep"));
}

TEST(CompletedSteps, AreCompletedWithFixedStepsToo) {
  const SeenCharts seen = charts(Formulation::kIndex2, fixedSteps(0.01));
  ASSERT_EQ(seen.solution.outcome, Outcome::kSuccess) << seen.solution.detail;
  // phi = pi/2, 3 pi/2, 5 pi/2: the grid's next points are 1.58, 4.72 and 7.86, and x_1' counts the charts since.
  EXPECT_EQ(seen.modes, (std::vector<double>{1, 2, 3}));
  EXPECT_NEAR(seen.solution.state.x[0], std::tan((10 - 3 * std::numbers::pi) / 2), 1e-9);
  EXPECT_NEAR(seen.solution.state.x[1], (10 - 1.58) + (10 - 4.72) + (10 - 7.86), 1e-11);
}

/// A point on the unit circle, phi = t. A step that ends with x < 0 asks for the axes to be turned around.
struct TurnedAxes : OnUnitCircle {
  Sizes sizes() const { return {.nu = 2, .nz = 1, .constraints = 1, .discrete = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    for (Index i = 0; i < 2; ++i) r.u[i] = p.a[i] + p.z[0] * p.u[i];
  }
  template <class T>
  bool completeStep(const Point<T>& p, T* u, T* v, T*, T* d) const {
    if (!(p.u[0] < T(0.0))) return false;
    for (Index i = 0; i < 2; ++i) u[i] = -p.u[i], v[i] = -p.v[i];
    d[0] = p.d[0] + 1.0;
    return true;
  }
};

TEST(CompletedSteps, MayTurnTheAxesInEachFormulation) {
  for (const auto formulation : {Formulation::kIndex3, Formulation::kIndex2, Formulation::kIndex2Projected,
                                 Formulation::kGgl, Formulation::kIndex1, Formulation::kFirstOrder}) {
    Integrator<double> integrator(makeSystem<double>(TurnedAxes{}, {formulation}), makeTableau<double>("radau_iia_3"),
                                  adaptive(1e-8));
    const auto end = integrator.integrate(startOf(TurnedAxes{}, {.u = {1, 0}, .v = {0, 1}}), 4);
    ASSERT_EQ(end.outcome, Outcome::kSuccess) << idOf(formulation) << end.detail;
    EXPECT_EQ(end.state.d[0], 1) << idOf(formulation);
    EXPECT_NEAR(end.state.u[0], std::cos(4 - std::numbers::pi), 1e-5) << idOf(formulation);
    EXPECT_NEAR(end.state.v[0], -std::sin(4 - std::numbers::pi), 1e-5) << idOf(formulation);
  }
}

}  // namespace
}  // namespace irk::test
