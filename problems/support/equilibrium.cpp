#include "problems/support/equilibrium.h"

#include <Eigen/LU>
#include <cmath>

#include "core/derivatives/differentiator.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

constexpr int kMaxIterations = 50;

// dr/d(u, x, z), made of columns of D2, D1 and D0.
template <class Real>
Mat<Real> staticJacobian(const Linearization<Real>& D, const Sizes& n) {
  Mat<Real> J(n.n(), n.n());
  J.leftCols(n.nu) = D.dense2().leftCols(n.nu);
  J.middleCols(n.nu, n.nx) = D.dense1().middleCols(n.nu, n.nx);
  J.rightCols(n.nz) = D.dense0().rightCols(n.nz);
  return J;
}

}  // namespace

template <class Real>
Equilibrium<Real> findEquilibrium(const System<Real>& system, const State<Real>& guess) {
  using std::cbrt;
  const Sizes n = system.sizes();
  Equilibrium<Real> found{.outcome = Outcome::kNewtonFailed, .state = guess, .iterations = 0};
  State<Real>& s = found.state;
  s.v.setZero();
  s.w.head(n.nu + n.nx).setZero();
  // Newton's error is about the square of its last step: after a step smaller than this it is below eps.
  const Real eps = Eigen::NumTraits<Real>::epsilon();
  const Real small = cbrt(eps * eps);
  Differentiator<Real> differentiator(system, DerivativeSource::kAutomatic);
  Linearization<Real> D(Pattern::dense(n.n()));
  Vec<Real> r(n.n());
  while (found.iterations < kMaxIterations) {
    ++found.iterations;
    system.evaluate(Level::kPosition, pointOf(s), VecView<Real>(r.data(), n.n()));
    differentiator.evaluate(Level::kPosition, pointOf(s), D);
    const Eigen::FullPivLU<Mat<Real>> lu(staticJacobian(D, n));
    const Vec<Real> step = lu.solve(r);
    if (!r.allFinite() || !step.allFinite()) {
      found.outcome = Outcome::kNotFinite;
      return found;
    }
    if (!lu.isInvertible()) {
      found.outcome = Outcome::kSingular;
      return found;
    }
    s.u -= step.head(n.nu);
    s.x -= step.segment(n.nu, n.nx);
    s.w.tail(n.nz) -= step.tail(n.nz);
    const Real size = 1 + s.u.norm() + s.x.norm() + s.w.norm();
    if (step.norm() <= small * size) {
      found.outcome = Outcome::kSuccess;
      return found;
    }
  }
  return found;
}

template <class Real>
Equilibrium<Real> findEquilibrium(const LoadedSystem<Real>& system, const State<Real>& guess, int load_steps) {
  Equilibrium<Real> found{.outcome = Outcome::kSuccess, .state = guess, .iterations = 0};
  for (int i = 1; i <= load_steps && found.outcome == Outcome::kSuccess; ++i) {
    const int before = found.iterations;
    found = findEquilibrium(*system(Real(i) / load_steps), found.state);
    found.iterations += before;
  }
  return found;
}

template Equilibrium<double> findEquilibrium(const System<double>&, const State<double>&);
template Equilibrium<BigFloat> findEquilibrium(const System<BigFloat>&, const State<BigFloat>&);
template Equilibrium<double> findEquilibrium(const LoadedSystem<double>&, const State<double>&, int);
template Equilibrium<BigFloat> findEquilibrium(const LoadedSystem<BigFloat>&, const State<BigFloat>&, int);

}  // namespace irk
