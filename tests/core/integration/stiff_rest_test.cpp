// Errors of stiff components that a method with |R(infinity)| = 1 does not damp are found at the end.
#include "core/integration/stiff_rest.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/system/counting.h"
#include "tests/core/support.h"

namespace irk::test {
namespace {

/// x' = lambda (x - cos t) - sin t: x = cos t, which a stiff x comes back to.
struct ProtheroRobinson {
  double lambda;
  Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    r.x[0] = lambda * (p.x[0] - cos(p.t)) - sin(p.t) - p.k[0];
  }
};

/// u'' = lambda (u' + sin t) - cos t: u = cos t.
struct StiffVelocity {
  double lambda;
  Sizes sizes() const { return {.nu = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    r.u[0] = lambda * (p.v[0] + sin(p.t)) - cos(p.t) - p.a[0];
  }
};

/// The rest that is found, in tolerances, after a step of size h from t = 0 whose stages are those of cos t, and which
/// ends off by `error`.
template <class P>
double restOf(const P& problem, double h, double tol, double error) {
  const auto system = makeSystem<double>(problem, {});
  const Scheme<double> scheme(makeTableau<double>("gauss_4"));
  const IntegratorOptions options = adaptive(tol);
  Counters counters;
  const CountingSystem<double> counted(*system, counters, 1);
  SharedJacobian<double> jacobian(counted, scheme, options, counters);
  ErrorNorm<double> norm(counted, options.tolerances, {});
  StiffRest<double> rest(counted, options, jacobian, norm, counters);
  const bool second_order = system->sizes().nu == 1;
  const auto at = [&](double t) {
    State<double> state(system->sizes());
    state.t = t;
    (second_order ? state.u : state.x)[0] = std::cos(t);
    if (second_order) state.v[0] = -std::sin(t);
    state.w[0] = second_order ? -std::cos(t) : -std::sin(t);
    return state;
  };
  const State<double> from = at(0);
  StagePolynomial<double> stages{&scheme, 0, h, Mat<double>(1, scheme.s), true};
  for (Index i = 0; i < scheme.s; ++i) stages.W.col(i) = at(scheme.c[i] * h).w;
  StageEquations<double> eq(counted, scheme, options.summation, 1);
  eq.begin(from, h);
  jacobian.evaluate(eq, stages.W);
  State<double> end = at(h);
  (second_order ? end.v : end.x)[0] += error;
  norm.update(end);
  const double weight = norm.weights()[second_order ? 1 : 0];
  const double components = second_order ? 2 : 1;
  return rest.error({&from, &stages}, end) * weight * std::sqrt(components);
}

TEST(StiffRest, IsTheErrorOfAStiffComponent) {
  for (const double lambda : {-1e7, -1e12}) {
    EXPECT_NEAR(restOf(ProtheroRobinson{lambda}, 0.1, 1e-8, 1e-5), 1e-5, 1e-8) << lambda;
    EXPECT_NEAR(restOf(ProtheroRobinson{lambda}, 0.1, 1e-8, -1e-5), 1e-5, 1e-8) << lambda;
    EXPECT_NEAR(restOf(StiffVelocity{lambda}, 0.1, 1e-8, 1e-5), 1e-5, 1e-8) << lambda;
    EXPECT_LT(restOf(ProtheroRobinson{lambda}, 0.1, 1e-8, 0), 1e-12) << lambda;
  }
}

// What a method damps, or the motion itself, is no rest: neither the error of the end nor that of the polynomial, which
// is of lower order and 1e-5 here.
TEST(StiffRest, IsNotTheErrorOfOtherComponents) {
  for (const double lambda : {-1.0, -10.0, 10.0}) {
    EXPECT_LT(restOf(ProtheroRobinson{lambda}, 0.5, 1e-8, 1e-5), 1e-8) << lambda;
    EXPECT_LT(restOf(StiffVelocity{lambda}, 0.5, 1e-8, 1e-5), 1e-8) << lambda;
  }
}

/// E5 of the IVP test set; y2 = y3 + y4 is algebraic. From t = 1e9 on y4 decays with y1, much faster than its steps.
struct E5 {
  Sizes sizes() const { return {.nx = 3, .nz = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T &y1 = p.x[0], &y3 = p.x[1], &y4 = p.x[2], &y2 = p.z[0];
    const T first = 1.1e7 * (y1 * y3);
    r.x[0] = -7.89e-10 * y1 - first - p.k[0];
    r.x[1] = 7.89e-10 * y1 - 1.13e9 * (y2 * y3) - p.k[2] - p.k[1];
    r.x[2] = first - 1.13e3 * y4 - p.k[2];
    r.z[0] = y3 + y4 - y2;
  }
};

// y4 is 0 at the end. What Gauss leaves of it may be thousands of tolerances, though all steps keep theirs. A run may
// also end because the motion has multiplied the errors of its steps.
TEST(StiffRest, MakesARunInaccurate) {
  constexpr double kScale = 1.7e-24;
  State<double> start(E5{}.sizes());
  start.x[0] = 1.76e-3;
  int inaccurate = 0, right = 0;
  for (const char* method : {"gauss_2", "gauss_4"}) {
    for (const double tol : {1e-8, 2e-9, 1e-10, 1e-11, 5e-12, 2e-12, 1e-12}) {
      Integrator<double> integrator(makeSystem<double>(E5{}, {}), makeTableau<double>(method), adaptive(tol),
                                    Vec<double>::Constant(4, kScale));
      const auto s = integrator.integrate(start, 1e13);
      const double error = std::abs(s.state.x[2]) / kScale;
      if (s.outcome == Outcome::kSuccess) {
        ++right;
        EXPECT_LT(error, 1000 * tol + 1e-9) << method << " " << tol;
      } else if (s.outcome == Outcome::kInaccurate && s.state.t == 1e13) {
        EXPECT_GT(error, 200 * tol) << method << " " << tol;
        const bool carried = s.detail.find("the motion has multiplied") != std::string::npos;
        inaccurate += !carried;
        if (!carried) {
          EXPECT_NE(s.detail.find("largest in x[2]"), std::string::npos) << s.detail;
        }
      }
    }
  }
  EXPECT_GE(right, 4);
  EXPECT_GE(inaccurate, 1);
}

}  // namespace
}  // namespace irk::test
