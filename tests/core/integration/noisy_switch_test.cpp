// Location of switches whose functions have more round-off than time has.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <type_traits>

#include "tests/core/switching_run.h"

namespace irk::test {
namespace {

/// A two-point control around `level`: x' = d q - x / tau, on up to level + band, off down to level - band. Its
/// switching function x - level has the round-off of the level, which divided by its slope is longer than the last
/// digits of t.
struct TwoPointControl {
  double level = 293.15, band = 0.5, q = 0.06, tau = 7200;
  Sizes sizes() const { return {.nx = 1, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = p.d[0] * q - p.x[0] / tau - p.k[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = p.d[0] > T(0.5) ? T(p.x[0] - (level + band)) : T(level - band - p.x[0]);
  }
  template <class T>
  void onSwitch(Index, const Point<T>& p, T* d) const {
    d[0] = 1.0 - p.d[0];
  }
  State<double> start() const { return startOf(sizes(), {.x = {level}, .d = {1}}); }
  // From switch to switch in closed form.
  double at(double t) const {
    double now = 0, x = level;
    for (bool on = true;; on = !on) {
      const double rest = on ? q * tau : 0, to = on ? level + band : level - band;
      const double dt = -tau * std::log((to - rest) / (x - rest));
      if (now + dt > t) return rest + (x - rest) * std::exp(-(t - now) / tau);
      now += dt;
      x = to;
    }
  }
};

TEST(NoisySwitch, IsLocatedToItsRoundOff) {
  for (const double scale : {1.0, 1e4}) {  // kelvin, and a pressure of some bar
    TwoPointControl control;
    control.level *= scale, control.band *= scale, control.q *= scale;
    for (const double tol : {1e-8, 1e-10, 1e-12}) {
      for (const char* method : {"radau_iia_3", "radau_iia_5", "gauss_4"}) {
        for (const auto& options : {adaptive(tol), embedded(tol)}) {
          const Result r = run(control, control.start(), 7200, Discontinuity::kLocate, options, method);
          ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << method << " tol " << tol << r.solution.detail;
          const double exact = control.at(7200);
          EXPECT_NEAR(r.solution.state.x[0] / exact, 1, 100 * tol + 1e-12) << method << " tol " << tol << " " << scale;
        }
      }
    }
  }
}

// A switch is met exactly: g = 0 at a step's end does not count as due, and location must not creep towards it.
TEST(NoisySwitch, TakesFewAttempts) {
  const TwoPointControl control;
  const Result r = run(control, control.start(), 7200, Discontinuity::kLocate, embedded(1e-10), "radau_iia_5");
  const auto& c = r.solution.counters;
  ASSERT_GT(c.located_events, 20);
  // Four or five solves per switch, and the steps between; 25 per switch before.
  EXPECT_LT(c.newton_iterations, 60 * c.located_events);
}

/// A ball falls on a lift that rises with c m/s. Its jump sets u = c t, and the switching function c t - u is then the
/// round-off of the product: with fused multiplication and addition it is not zero, and of either sign.
struct BallOnALift {
  double c;
  static constexpr double kGravity = 9.81, kRestitution = 0.9;
  Sizes sizes() const { return {.nu = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -p.a[0] - kGravity;
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    if constexpr (std::is_same_v<T, double>) {
      g[0] = std::fma(c, p.t, -p.u[0]);
    } else {
      g[0] = c * p.t - p.u[0];
    }
  }
  template <class T>
  void onSwitch(Index, const Point<T>&, T*) const {}
  template <class T>
  void jump(Index, const Point<T>& p, T* u, T* v, T*) const {
    u[0] = c * p.t;
    v[0] = c - kRestitution * (p.v[0] - c);
  }
  State<double> start() const { return startOf(sizes(), {.u = {1}}); }
  // (u, v) at t, from impact to impact: y is the height above the lift, and falls with g.
  std::array<double, 2> at(double t, int& impacts) const {
    double now = 0, y = 1, w = -c;
    for (impacts = 0;; ++impacts) {
      const double until = (w + std::sqrt(w * w + 2 * kGravity * y)) / kGravity;
      if (now + until > t) break;
      now += until;
      w = -kRestitution * (w - kGravity * until);
      y = 0;
    }
    const double rest = t - now;
    return {y + rest * (w - kGravity / 2 * rest) + c * t, w - kGravity * rest + c};
  }
};

TEST(NoisySwitch, IsNotDueAgainByItsRoundOffBehindAJump) {
  int noisy = 0;
  for (const double c : {0.3, 0.25, 0.1, -0.1, 0.37, 0.7}) {
    for (const double tol : {1e-4, 1e-8, 1e-12}) {
      for (const auto& options : {adaptive(tol), embedded(tol)}) {
        const BallOnALift lift{c};
        const Result r = run(lift, lift.start(), 3, Discontinuity::kLocate, options, "radau_iia_5");
        ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << c << " tol " << tol << ": " << r.solution.detail;
        int impacts = 0;
        const auto exact = lift.at(3, impacts);
        EXPECT_EQ(r.solution.counters.switches, impacts) << c << " tol " << tol;
        EXPECT_NEAR(r.solution.state.u[0], exact[0], 20 * tol + 1e-12) << c;
        EXPECT_NEAR(r.solution.state.v[0], exact[1], 20 * tol + 1e-12) << c;
        for (const Event& event : r.events) noisy += std::fma(c, event.t, -(c * event.t)) > 0;
      }
    }
  }
  EXPECT_GT(noisy, 10) << "the test shows nothing";
}

}  // namespace
}  // namespace irk::test
