// The exact solution of piecewise linear scenes if several switches, with jumps, fall into one of its steps.
#include "problems/support/piecewise_linear.h"

#include <gtest/gtest.h>

#include <cmath>

#include "irk/multiprecision.h"
#include "irk/problem.h"

namespace irk {
namespace {

/// A ball that falls with g = 2 from height 1, passes a mark at 0.1, and hits a floor that returns half of its speed.
struct Ball {
  Sizes sizes() const { return {.nu = 1, .nx = 0, .nz = 0, .constraints = 0, .discrete = 2, .switches = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -2.0 - p.a[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = p.v[0] < T(0.0) ? T(-p.u[0]) : T(-1.0);
    g[1] = p.d[1] < T(0.5) ? T(0.1 - p.u[0]) : T(-1.0);
  }
  template <class T>
  void onSwitch(Index i, const Point<T>& p, T* d) const {
    d[i] = d[i] + 1.0;
    if (i == 1) d[1] = 1.0 + p.t;  // time of passing the mark, plus 1
  }
  template <class T>
  void jump(Index i, const Point<T>& p, T*, T* v, T*) const {
    if (i == 0) v[0] = -0.5 * p.v[0];
  }
};

TEST(PiecewiseLinearSolution, TakesTheEarliestSwitchAndJumps) {
  const Ball problem;
  PiecewiseLinear<double> exact{makeSystem<double>(problem), State<double>(problem.sizes()),
                                [](const Vec<double>&) {
                                  Mat<double> rows(1, 3);  // v' of (u, v, 1)
                                  rows << 0, 0, -2;
                                  return rows;
                                },
                                0};
  exact.start.u[0] = 1;
  // Down at t = 1 with -2, up with 1, down at t = 2 with -1, up with 0.5.
  const auto at = exact(2.25);
  EXPECT_NEAR(at.u[0], 0.25 * 0.5 - 0.25 * 0.25, 1e-12);
  EXPECT_NEAR(at.v[0], 0, 1e-12);
  EXPECT_EQ(at.d[0], 2);
  EXPECT_NEAR(at.d[1], 1 + std::sqrt(0.9), 1e-12);
  EXPECT_NEAR(exact(1.5).u[0], 0.25, 1e-12);
}

/// An oscillation u = sin t, which passes a mark just below its peak; d = the time of passing.
template <class Real>
struct Peak {
  Sizes sizes() const { return {.nu = 1, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -p.u[0] - p.a[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = p.d[0] > T(0.0) ? T(-1.0) : T(p.u[0] - 0.9999);
  }
  template <class T>
  void onSwitch(Index, const Point<T>& p, T* d) const {
    d[0] = p.t;
  }
  void start(State<Real>& s) const { s.v[0] = 1; }
  Mat<Real> rates(const Vec<Real>&) const {
    Mat<Real> rows(1, 3);  // v' of (u, v, 1)
    rows << -1, 0, 0;
    return rows;
  }
};

template <class Real>
double timeOfPassing() {
  return static_cast<double>(exactBetweenSwitches<Real>(Peak<Real>(), Real(2)).d[0]);
}

// The steps of the search are 0.25 long: the mark is passed and left again between 1.5 and 1.75.
TEST(PiecewiseLinearSolution, FindsASwitchThatIsDueInsideAStepOnly) {
  const double right = std::asin(0.9999);
  EXPECT_NEAR(timeOfPassing<double>(), right, 1e-11);
  EXPECT_NEAR(timeOfPassing<BigFloat>(), right, 1e-11);
}

}  // namespace
}  // namespace irk
