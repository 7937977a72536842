// Location of switches whose functions have more round-off than time has.
#include <gtest/gtest.h>

#include <cmath>

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
  State<double> start() const {
    State<double> s(sizes());
    s.x[0] = level;
    s.d[0] = 1;
    return s;
  }
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

}  // namespace
}  // namespace irk::test
