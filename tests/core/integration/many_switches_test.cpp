// Problems with many switching functions, and with functions that switch much more often than a step ends.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "irk/integrator.h"
#include "tests/core/switching_run.h"

namespace irk::test {
namespace {

constexpr Index kTanks = 18;

/// Tanks of water that empty at t_i = 1 + i / 10 and then stay empty. The level falls by (2 t_i - t) / t_i^2, from 3/2
/// at t = 0.
struct Tanks {
  static double emptyAt(Index i) { return 1 + 0.1 * static_cast<double>(i); }

  Sizes sizes() const { return {.nx = kTanks, .discrete = kTanks, .switches = kTanks}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    for (Index i = 0; i < kTanks; ++i) {
      r.x[i] = (p.d[i] > T(0.0) ? T(0.0) : T((p.t - 2 * emptyAt(i)) / (emptyAt(i) * emptyAt(i)))) - p.k[i];
    }
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    for (Index i = 0; i < kTanks; ++i) g[i] = p.d[i] > T(0.0) ? T(-1.0) : T(-p.x[i]);
  }
  template <class T>
  void onSwitch(Index i, const Point<T>&, T* d) const {
    d[i] = T(1.0);
  }
};

State<double> fullTanks() {
  State<double> start(Tanks{}.sizes());
  start.x.setConstant(1.5);
  return start;
}

TEST(ManySwitches, EachIsLocatedInItsTurn) {
  const auto [solution, events] = run(Tanks{}, fullTanks(), 4, Discontinuity::kLocate, adaptive(1e-8));
  ASSERT_EQ(solution.outcome, Outcome::kSuccess);
  ASSERT_EQ(events.size(), static_cast<std::size_t>(kTanks));
  for (Index i = 0; i < kTanks; ++i) {
    EXPECT_EQ(events[static_cast<std::size_t>(i)].index, i);
    EXPECT_NEAR(events[static_cast<std::size_t>(i)].t, Tanks::emptyAt(i), 1e-9);
    EXPECT_NEAR(solution.state.x[i], 0, 1e-9);
  }
}

// Here the problem's own functions are asked for the mode in each evaluation of the residual.
TEST(ManySwitches, AreImpliedWhereTheyAreNotLocated) {
  const auto [solution, events] = run(Tanks{}, fullTanks(), 4, Discontinuity::kIgnore, adaptive(1e-6));
  ASSERT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
  for (Index i = 0; i < kTanks; ++i) EXPECT_NEAR(solution.state.x[i], 0, 1e-4) << i;
}

/// A filter x' = d - x behind pulses: d = 1 while the carrier cos(100 t) is above 1/2.
struct CarrierPulses {
  Sizes sizes() const { return {.nx = 1, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = p.d[0] - p.x[0] - p.k[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    using std::cos;
    const T above = cos(100 * p.t) - 0.5;
    g[0] = p.d[0] > T(0.5) ? T(-above) : above;
  }
  template <class T>
  void onSwitch(Index, const Point<T>& p, T* d) const {
    d[0] = 1 - p.d[0];
  }
  // x(t) from x(0) = 0, by the exact solution between the pulses.
  static double exact(double t) {
    double x = 0, since = 0, d = 1;
    const auto goTo = [&](double time) {
      x = d + (x - d) * std::exp(since - time);
      since = time;
    };
    for (int k = 1; std::numbers::pi * (k - 1) / 100 < t; ++k) {
      const int even = k / 2 * 2;
      const double turn = std::numbers::pi * even / 100, third = std::numbers::pi / 300;
      const double next = k % 2 == 1 ? turn + third : turn - third;  // falls at odd k, rises at even k
      if (next >= t) break;
      goTo(next);
      d = 1 - d;
    }
    goTo(t);
    return x;
  }
};

// One method, or Radau IIA of variable order.
template <class P>
Solution<double> integrated(const P& problem, const State<double>& start, double t_end, int stages, double tol) {
  const auto system = makeSystem<double>(problem, {});
  if (stages > 0) {
    const std::string method = "radau_iia_" + std::to_string(stages);
    return Integrator<double>(system, makeTableau<double>(method), embedded(tol)).integrate(start, t_end);
  }
  return Integrator<double>(system, makeMethods<double>("radau_iia", 13, 3), variable(tol)).integrate(start, t_end);
}

// A solution that hardly changes has long steps, in each of which the carrier would have many periods.
TEST(ManySwitches, PulsesShorterThanAStepAreAllFound) {
  const auto start = startOf(CarrierPulses{}, {.d = {1}});
  for (const double tol : {1e-3, 1e-6}) {
    for (const int stages : {0, 3, 5}) {
      const auto solution = integrated(CarrierPulses{}, start, 5, stages, tol);
      ASSERT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
      EXPECT_EQ(solution.counters.located_events, 159) << tol << ", stages " << stages;
      EXPECT_NEAR(solution.state.x[0], CarrierPulses::exact(5), 100 * tol);
    }
  }
}

/// A shaft with one revolution in 1/8 s that starts from rest in 1/2 s, and the pulses of an encoder: d counts the
/// half revolutions.
struct Encoder {
  Sizes sizes() const { return {.nu = 1, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::exp;
    r.u[0] = 2 * (16 * std::numbers::pi - p.v[0]) - p.a[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    using std::sin;
    const bool odd = std::fmod(valueOf(p.d[0]), 2) > 0.5;
    g[0] = odd ? sin(p.u[0]) : T(-sin(p.u[0]));
  }
  template <class T>
  void onSwitch(Index, const Point<T>& p, T* d) const {
    d[0] = p.d[0] + 1;
  }
};

TEST(ManySwitches, AnEncoderLosesNoPulse) {
  const auto start = startOf(Encoder{}, {.u = {-0.1}, .d = {1}});
  const double v = 16 * std::numbers::pi, end = 4;
  const double angle = start.u[0] + v * (end - (1 - std::exp(-2 * end)) / 2);
  for (const int stages : {0, 3, 5}) {
    const auto solution = integrated(Encoder{}, start, end, stages, 1e-7);
    ASSERT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
    EXPECT_NEAR(solution.state.u[0], angle, 1e-4);
    EXPECT_EQ(solution.state.d[0], std::floor(angle / std::numbers::pi) + 2);
  }
}

}  // namespace
}  // namespace irk::test
