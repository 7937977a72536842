// A success must be right: each test is a case in which a run with a wrong result was called a success.
#include <gtest/gtest.h>
#include <cmath>

#include "tests/core/switching_run.h"

namespace irk::test {
namespace {

/// A ball on an elastic floor without gravity: it hits the floor at t = 1 with speed 1, and leaves it half a period
/// of the contact later with the opposite speed.
struct Elastic {
  double k = 1e8;
  Sizes sizes() const { return {.nu = 1, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -k * (p.d[0] * p.u[0]) - p.a[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = p.d[0] > T(0.5) ? T(p.u[0]) : T(-p.u[0]);
  }
  template <class T>
  void onSwitch(Index, const Point<T>& p, T* d) const {
    d[0] = 1.0 - p.d[0];
  }
  State<double> start() const { return startOf(sizes(), {.u = {1}, .v = {-1}}); }
  double heightAt(double t) const { return t - 1 - std::acos(-1.0) / std::sqrt(k); }
};

// The step before the contact is long. L-stable methods damp the fast motion in one step of this size, both in the
// whole step and in its halves: the ball would stay on the floor.
TEST(Success, FastMotionThatStartsAtASwitchIsFollowed) {
  for (const double k : {1e4, 1e6, 1e8, 1e10}) {
    const Elastic ball{k};
    for (const char* method : {"radau_iia_3", "radau_iia_5", "radau_iia_9", "lobatto_iiic_3"}) {
      for (const double tol : {1e-4, 1e-7, 1e-10}) {
        for (const auto& options : {adaptive(tol), embedded(tol)}) {
          const Result r = run(ball, ball.start(), 3, Discontinuity::kLocate, options, method);
          ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
          EXPECT_EQ(r.events.size(), 2u) << method << " k " << k << " tol " << tol;
          EXPECT_NEAR(r.solution.state.u[0], ball.heightAt(3), 300 * tol) << method << " k " << k << " tol " << tol;
        }
      }
    }
  }
}

// Without location, the error of a step with a switch is bounded by the effect of the wrong mode over the step.
TEST(Success, ContactInsideOneStepIsSeenWithoutLocation) {
  const Elastic ball{1e6};
  for (const Discontinuity mode : {Discontinuity::kIgnore, Discontinuity::kIterate}) {
    for (const char* method : {"gauss_3", "gauss_5", "radau_ia_3", "radau_iia_9"}) {
      for (const double tol : {1e-4, 1e-8}) {
        for (const auto& options : {adaptive(tol), embedded(tol)}) {
          const Result r = run(ball, ball.start(), 3, mode, options, method);
          ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << method << r.solution.detail;
          EXPECT_NEAR(r.solution.state.u[0], ball.heightAt(3), 1e3 * tol)
              << idOf(mode) << " " << method << " tol " << tol;
        }
      }
    }
  }
}

// The pulse lasts a hundredth of the distance between two samples; it also occurs at both ends of a step.
TEST(Success, SwitchThatComesAndGoesBetweenTwoSamplesIsFound) {
  for (const double centre : {0.002, 0.03, 0.06, 0.3, 0.53, 0.77, 0.94, 0.97, 0.998}) {
    const OnFor problem{centre - 1e-3, 2e-3};
    const State<double> start(problem.sizes());
    for (IntegratorOptions options : {adaptive(1e-8), embedded(1e-8)}) {
      options.step.h = 1;  // the whole interval is the first step
      const Result r = run(problem, start, 1, Discontinuity::kLocate, options);
      ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
      ASSERT_EQ(r.events.size(), 2u) << centre;
      EXPECT_NEAR(r.events[0].t, centre - 1e-3, 1e-10);
      EXPECT_NEAR(r.solution.state.x[0], 2e-3, 1e-10) << centre;
    }
  }
}

/// On between `on` and `off`. The switching function is the minimum of a steep and a flat line, as for a slider that
/// yields while it moves: a corner, whose maximum a parabola through samples does not find.
struct Tent {
  double on, off, up, down;
  Sizes sizes() const { return {.nx = 1, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = p.d[0] * (2.0 - p.d[0]) - p.k[0];  // 1 while d = 1
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    const T rises = up * (p.t - on), falls = down * (off - p.t);
    g[0] = p.d[0] > T(1.5) ? T(-1.0) : p.d[0] > T(0.5) ? T(p.t - off) : rises < falls ? rises : falls;
  }
  template <class T>
  void onSwitch(Index, const Point<T>& p, T* d) const {
    d[0] = p.d[0] + 1.0;
  }
};

TEST(Success, CornerThatRisesAboveZeroNextToAnEndOfAStepIsFound) {
  for (const Tent problem : {Tent{0.004, 0.008, 4, 1}, Tent{0.01, 0.011, 1, 1}, Tent{0.02, 0.1, 9, 2},
                             Tent{0.06, 0.065, 2, 1}, Tent{0.992, 0.996, 1, 4}, Tent{0.94, 0.95, 1, 2}}) {
    const State<double> start(problem.sizes());
    for (IntegratorOptions options : {adaptive(1e-8), embedded(1e-8)}) {
      options.step.h = 1;  // the whole interval is the first step
      const Result r = run(problem, start, 1, Discontinuity::kLocate, options);
      ASSERT_EQ(r.solution.outcome, Outcome::kSuccess) << r.solution.detail;
      ASSERT_EQ(r.events.size(), 2u) << problem.on;
      EXPECT_NEAR(r.events[0].t, problem.on, 1e-10);
      EXPECT_NEAR(r.solution.state.x[0], problem.off - problem.on, 1e-10) << problem.on;
    }
  }
}

/// A system with a switch that the problem does not declare: x' = 1 from t = 0.5123 on.
struct Undeclared {
  double at = 0.5123;
  Sizes sizes() const { return {.nu = 1, .nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T on = p.t > T(at) ? T(1.0) : T(0.0);
    r.u[0] = -p.u[0] + on - p.a[0];
    r.x[0] = on * 1.0 - p.k[0];
  }
};

// With nine stages 2^p - 1 is 131071; the estimate may divide by it only if the halves show that order. (The stages
// of Gauss methods do not include the ends of a step, so no estimate detects an undeclared jump there.)
TEST(Success, DoublingSeesAJumpThatNobodyDeclares) {
  for (const double at : {0.0123, 0.3, 0.5123, 0.77, 0.9}) {
    const Undeclared problem{at};
    const State<double> start(problem.sizes());
    for (const char* method : {"radau_iia_3", "radau_iia_5", "radau_iia_9", "lobatto_iiic_6"}) {
      for (const double tol : {1e-4, 1e-8}) {
        const auto s = integrate<double>(problem, start, 1, makeTableau<double>(method), adaptive(tol));
        ASSERT_EQ(s.outcome, Outcome::kSuccess) << method << s.detail;
        EXPECT_NEAR(s.state.x[0], 1 - at, 100 * tol) << method << " at " << at << " tol " << tol;
        EXPECT_NEAR(s.state.u[0], 1 - std::cos(1 - at), 100 * tol) << method << " at " << at;
      }
    }
  }
}

}  // namespace
}  // namespace irk::test
