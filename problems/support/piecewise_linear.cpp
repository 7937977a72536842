#include "problems/support/piecewise_linear.h"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>

#include "irk/multiprecision.h"

namespace irk {
namespace {

// One phase between two switches, y' = A y; converts between the state and y.
template <class Real>
struct Phase {
  Index nu, nx;
  Mat<Real> A;
  Vec<Real> y;

  Phase(const PiecewiseLinear<Real>& of, const State<Real>& s) : nu(s.u.size()), nx(s.x.size()) {
    using std::cos;
    using std::sin;
    const Mat<Real> rates = of.rates(s.d);
    const Index n = rates.cols(), first = 2 * nu + nx + 1;
    A = Mat<Real>::Zero(n, n);
    A.topRows(nu).middleCols(nu, nu).setIdentity();
    A.middleRows(nu, nu + nx) = rates;
    y = Vec<Real>::Ones(n);
    y.head(first - 1) << s.u, s.v, s.x;
    if (n == first) return;
    y.tail(2) << sin(of.omega * s.t), cos(of.omega * s.t);
    A(first, first + 1) = of.omega;
    A(first + 1, first) = -of.omega;
  }

  // Largest time over which the series below loses no digits: a quarter of the fastest time constant.
  Real step() const {
    using std::sqrt;
    const Real rate = sqrt(Mat<Real>(A * A).template lpNorm<Eigen::Infinity>());
    return rate > 0 ? Real(1 / (4 * rate)) : Eigen::NumTraits<Real>::highest();
  }
  // The state after the time tau: exp(A tau) y by its power series.
  State<Real> after(const Real& tau, const State<Real>& from) const {
    const Real eps = Eigen::NumTraits<Real>::epsilon();
    Vec<Real> sum = y, term = y;
    for (int i = 1; term.norm() > eps * eps * sum.norm(); ++i) {
      term = Vec<Real>(A * term) * (tau / i);
      sum += term;
    }
    State<Real> s = from;
    s.t += tau;
    s.u = sum.head(nu);
    s.v = sum.segment(nu, nu);
    s.x = sum.segment(2 * nu, nx);
    s.w = Vec<Real>(A * sum).segment(nu, nu + nx);
    return s;
  }
};

template <class Real>
Vec<Real> switching(const System<Real>& system, const State<Real>& s) {
  Vec<Real> g(system.sizes().switches);
  system.switching(pointOf(s), VecView<Real>(g.data(), g.size()));
  return g;
}

// Finds a time in (0, step) at which g > 0, for g <= 0 at both ends; returns 0 if there is none. Over a quarter of
// the fastest time constant g rises and falls at most once. g may be the minimum of two smooth functions.
template <class Real, class F>
Real positiveInside(const F& g, const Real& step, const Real& at_start, const Real& at_end) {
  const Real middle = g(Real(step / 2));
  const auto [least, most] = std::minmax({at_start, middle, at_end});
  if (middle > 0) return step / 2;
  if (most + (most - least) < 0) return 0;  // a peak rises above `most` by less than the three values differ
  // In double whatever Real is: Boost takes its accuracy from the number of digits of the type, which BigFloat has not.
  constexpr int kBits = std::numeric_limits<double>::digits / 2;
  const auto negative = [&](double tau) { return -static_cast<double>(g(Real(tau))); };
  const auto [at, value] = boost::math::tools::brent_find_minima(negative, 0.0, static_cast<double>(step), kBits);
  return value < 0 ? Real(at) : Real(0);
}

}  // namespace

template <class Real>
State<Real> PiecewiseLinear<Real>::operator()(const Real& t) const {
  State<Real> s = start;
  while (s.t < t) {
    const Phase<Real> phase(*this, s);
    const Real step = std::min(phase.step(), Real(t - s.t));
    State<Real> next = phase.after(step, s);
    const Vec<Real> before = switching(*system, s), after = switching(*system, next);
    Real first = step;
    Index due = -1;
    for (Index i = 0; i < after.size(); ++i) {
      const auto g = [&](const Real& tau) { return tau > 0 ? switching(*system, phase.after(tau, s))[i] : before[i]; };
      Real end = step, at_end = after[i];
      if (!(at_end > 0)) {
        end = before[i] < 0 ? positiveInside(g, step, before[i], after[i]) : Real(0);
        if (!(end > 0)) continue;
        at_end = g(end);
      }
      std::uintmax_t iterations = 200;
      const auto narrow = [](const Real& a, const Real& b) {
        return b - a <= 2 * Eigen::NumTraits<Real>::epsilon() * b;
      };
      const Real root =
          before[i] < 0
              ? boost::math::tools::toms748_solve(g, Real(0), end, before[i], at_end, narrow, iterations).second
              : Real(0);
      if (due < 0 || root < first) {
        first = root;
        due = i;
      }
    }
    if (due >= 0) {
      next = phase.after(first, s);
      system->onSwitch(due, next);
      system->jump(due, next);
    } else if (step == t - s.t) {
      next.t = t;
    }
    s = next;
  }
  return Phase<Real>(*this, s).after(Real(0), s);
}

template struct PiecewiseLinear<double>;
template struct PiecewiseLinear<BigFloat>;

}  // namespace irk
