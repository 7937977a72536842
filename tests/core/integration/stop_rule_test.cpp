// Integrations that end before t_end: at a switch, and where the state hardly changes.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "irk/error_bar.h"
#include "tests/core/support.h"
#include "tests/refusal.h"

namespace irk::test {
namespace {

/// A ball that falls from 1 m and keeps half of its speed at each impact: with t1 = sqrt(2 / g) impacts at t1, 2 t1 and
/// 2.5 t1, and speeds g t1 / 2^i behind them. `apex`: the ball turns.
struct Ball {
  double g = 9.81;
  Sizes sizes() const { return {.nu = 1, .discrete = 1, .switches = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -p.a[0] - g;
  }
  template <class T>
  void switching(const Point<T>& p, T* h) const {
    h[0] = -p.u[0];
    h[1] = p.d[0] > T(0.5) ? T(-p.v[0]) : T(-1.0);
  }
  template <class T>
  void onSwitch(Index i, const Point<T>&, T* d) const {
    d[0] = i == 0 ? 1.0 : 0.0;  // 1: on its way up
  }
  template <class T>
  void jump(Index i, const Point<T>& p, T* u, T* v, T*) const {
    if (i == 1) return;
    u[0] = 0.0;
    v[0] = -0.5 * p.v[0];
  }
  std::string switchName(Index i) const { return i == 0 ? "impact" : "apex"; }
};

struct Fall {
  IntegratorOptions options;
  Discontinuity treatment = Discontinuity::kLocate;

  explicit Fall(const std::string& stop_at, const IntegratorOptions& with = adaptive(1e-10)) : options(with) {
    options.stop_at = stop_at;
  }
  Integrator<double> integrator() const {
    return {makeSystem<double>(Ball{}, {.discontinuity = treatment}), makeTableau<double>("radau_iia_3"), options};
  }
  static State<double> start() { return startOf(Ball{}, {.u = {1}}); }
  Solution<double> to(double t_end) const { return integrator().integrate(start(), t_end); }
  std::string refusal() const {
    return irk::refusal([&] { static_cast<void>(integrator()); });
  }
};

const double kFirst = std::sqrt(2 / 9.81);

TEST(StopRule, ASwitchEndsTheIntegrationRightBehindIt) {
  const struct {
    const char* stop_at;
    double t, v;
  } cases[] = {{"impact", kFirst, 9.81 * kFirst / 2},
               {"impact:1", kFirst, 9.81 * kFirst / 2},
               {"apex", 1.5 * kFirst, 0},
               {"impact:3", 2.5 * kFirst, 9.81 * kFirst / 8}};
  for (const auto& one : cases) {
    const auto solution = Fall(one.stop_at).to(1.2);
    ASSERT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
    EXPECT_NEAR(solution.state.t, one.t, 1e-9) << one.stop_at;
    EXPECT_NEAR(solution.state.v[0], one.v, 1e-8) << one.stop_at;
    EXPECT_EQ(solution.detail.rfind(std::string("at the switch ") + one.stop_at, 0), 0u) << solution.detail;
  }
}

TEST(StopRule, FixedStepsEndThereToo) {
  const auto solution = Fall("impact:2", fixedSteps(0.1)).to(2);
  ASSERT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
  EXPECT_NEAR(solution.state.t, 2 * kFirst, 1e-10);
}

TEST(StopRule, AnObjectStartsToCountAnew) {
  auto integrator = Fall("impact:2").integrator();
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(integrator.integrate(Fall::start(), 1.2).state.t, 2 * kFirst, 1e-9) << i;
  }
}

TEST(StopRule, AnEventThatDoesNotComeIsNoSuccess) {
  const auto solution = Fall("impact:3").to(1);
  EXPECT_EQ(solution.outcome, Outcome::kNoEvent);
  EXPECT_EQ(name(solution.outcome), "no_event");
  EXPECT_TRUE(contains(solution.detail, "impact:3, which came 2 of 3 times"));
  EXPECT_EQ(solution.state.t, 1);
}

TEST(StopRule, WhatCannotBeIsRefused) {
  EXPECT_EQ(Fall("impakt:2").refusal(), "stop_at: unknown switch 'impakt'; did you mean 'impact'? Known: impact, apex");
  EXPECT_TRUE(contains(Fall("impact:0").refusal(), "stop_at impact:0"));
  EXPECT_TRUE(contains(Fall("impact:x").refusal(), "stop_at impact:x"));
  Fall smooth("impact");
  smooth.treatment = Discontinuity::kIgnore;
  EXPECT_NE(smooth.refusal(), "");
}

TEST(StopRule, TheErrorBarEndsAtItsOwnTimeOfTheSwitch) {
  const Fall fall("impact:3", adaptive(1e-6));
  const auto solution = fall.to(1.2);
  Integrator<double> second(makeSystem<double>(Ball{}, {.discontinuity = Discontinuity::kLocate}),
                            makeTableau<double>("lobatto_iiic_4"), Fall("impact:3").options);
  Solution<double> other;
  const ErrorBar bar = measureErrorBar<double>(solution.state, second, Fall::start(), fall.options.tolerances, {},
                                               other, {}, std::optional<double>(1.2));
  ASSERT_TRUE(bar.known()) << bar.problem;
  EXPECT_NEAR(bar.t, std::abs(solution.state.t - 2.5 * kFirst), 1e-9);
  EXPECT_LT(bar.t, 1e-5);
  EXPECT_LT(bar.v[0], 1e-4) << "both states are behind the impact";
}

// The rate is steady |x|, or steady times the scale 1, at t = log(1 / steady).
TEST(StopRule, AStateThatHardlyChangesEndsIt) {
  IntegratorOptions options;
  options.steady = 1e-3;
  options.step.h_max = 0.01;
  Integrator<double> integrator(makeSystem<double>(Decay{}), makeTableau<double>("radau_iia_3"), options);
  const auto solution = integrator.integrate(decayStart(), 100);
  ASSERT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
  EXPECT_NEAR(solution.state.t, std::log(1e3), 0.02) << "the first step's end behind it";
  EXPECT_EQ(solution.detail.rfind("steady to 0.001", 0), 0u) << solution.detail;
  const auto before = integrator.integrate(decayStart(), 6);
  EXPECT_EQ(before.outcome, Outcome::kNoEvent);
  EXPECT_TRUE(contains(before.detail, "steady to 0.001"));
}

}  // namespace
}  // namespace irk::test
