// Algebraic unknowns of index 1 that are small where their equation is nearly singular.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/support.h"

namespace irk::test {
namespace {

/// x' = z, z |z| + eps z = sin t: the volume x that flows through an orifice whose pressure is sin t; the linear part
/// eps is that of slow, laminar flow.
struct Orifice {
  double eps;
  Sizes sizes() const { return {.nx = 1, .nz = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::abs;
    using std::sin;
    r.x[0] = p.z[0] - p.k[0];
    r.z[0] = p.z[0] * abs(p.z[0]) + eps * p.z[0] - sin(p.t);
  }
};

// The volume at t = 1: the integral of z = (sqrt(eps^2 + 4 sin t) - eps) / 2 by Simpson's rule over s, t = s^2 - (eps /
// 2)^2.
double volume(double eps) {
  const double shift = eps * eps / 4, first = eps / 2, last = std::sqrt(1 + shift);
  const int intervals = 20000;
  const double h = (last - first) / intervals;
  double sum = 0;
  for (int i = 0; i <= intervals; ++i) {
    const double s = first + i * h, t = s * s - shift;
    const double z = (std::sqrt(eps * eps + 4 * std::sin(t)) - eps) / 2;
    sum += (i == 0 || i == intervals ? 1 : i % 2 == 1 ? 4 : 2) * 2 * s * z;
  }
  return sum * h / 3;
}

// A step leaves z with an error of a part of the tolerance, which at the beginning is more than z itself. Newton's
// method starts from it, and a shorter step would not bring that start nearer to the solution.
TEST(AlgebraicUnknowns, SmallErrorsOfThemDoNotStopARun) {
  for (const double eps : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
    const State<double> start(Orifice{eps}.sizes());
    for (const double tol : {1e-2, 3e-3, 1e-3, 3e-4, 1e-4, 1e-5, 1e-6}) {
      for (const auto& o : {embedded(tol), variable(tol)}) {
        const auto s = integrate<double>(Orifice{eps}, start, 1, makeTableau<double>("radau_iia_3"), o);
        ASSERT_EQ(s.outcome, Outcome::kSuccess) << "eps " << eps << ", tolerance " << tol << ": " << s.detail;
        EXPECT_NEAR(s.state.x[0], volume(eps), 10 * tol) << "eps " << eps;
      }
    }
  }
}

/// x' = i - (exp(40 z) - 1), x = z + z^3, where the current i jumps at an undeclared time.
struct UndeclaredCurrent {
  Sizes sizes() const { return {.nx = 1, .nz = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::exp;
    const double i = p.t > T(10.0) ? 1e6 : 1.0;
    r.x[0] = i - (exp(40.0 * p.z[0]) - 1.0) - p.k[0];
    r.z[0] = p.x[0] - p.z[0] * (1.0 + p.z[0] * p.z[0]);
  }
};

// A dozen attempts over the jump fail in a row. The state from which they start is the same.
TEST(AlgebraicUnknowns, AreSolvedForOnceInARowOfFailures) {
  const auto start = startOf(UndeclaredCurrent{}, {.x = {0.01}});
  const auto s = integrate<double>(UndeclaredCurrent{}, start, 100, makeTableau<double>("radau_iia_3"), embedded(1e-4));
  ASSERT_EQ(s.outcome, Outcome::kSuccess) << s.detail;
  const double z = std::log(1e6 + 1) / 40;
  EXPECT_NEAR(s.state.x[0], z * (1 + z * z), 1e-6);
  EXPECT_GE(s.counters.steps_rejected_newton, 20);
  // One for the start, one for the end, and one for each row of failures; one for each failure would be 18.
  EXPECT_GE(s.counters.mass_factorizations, 3);
  EXPECT_LE(s.counters.mass_factorizations, 10);
}

}  // namespace
}  // namespace irk::test
