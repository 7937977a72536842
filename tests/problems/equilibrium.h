// Static equilibrium of a system: r(t; u, 0, x; 0, 0, z) = 0.
#pragma once

#include <Eigen/LU>
#include <cmath>
#include <optional>

#include "core/derivatives/differentiator.h"

namespace irk::test {

/// u, x, z that solve r = 0 at rest, by Newton's method from those of `s`; nothing if it does not converge in 50
/// iterations. Position constraints enter as g = 0, whatever the formulation is.
template <class Real>
std::optional<State<Real>> equilibriumOf(const System<Real>& system, State<Real> s) {
  using std::cbrt;
  const Sizes n = system.sizes();
  s.v.setZero();
  s.w.head(n.nu + n.nx).setZero();
  Differentiator<Real> differentiator(system, DerivativeSource::kAutomatic);
  Linearization<Real> D(Pattern::dense(n.n()));
  Vec<Real> r(n.n());
  Mat<Real> J(n.n(), n.n());
  for (int i = 0; i < 50; ++i) {
    system.evaluate(Level::kPosition, pointOf(s), VecView<Real>(r.data(), n.n()));
    differentiator.evaluate(Level::kPosition, pointOf(s), D);
    J << D.dense2().leftCols(n.nu), D.dense1().middleCols(n.nu, n.nx), D.dense0().rightCols(n.nz);
    const Vec<Real> step = J.fullPivLu().solve(r);
    s.u -= step.head(n.nu);
    s.x -= step.segment(n.nu, n.nx);
    s.w.tail(n.nz) -= step.tail(n.nz);
    // The error is about the square of the last step: then it is below eps.
    const Real eps = Eigen::NumTraits<Real>::epsilon();
    if (step.norm() <= Real(cbrt(eps * eps)) * (1 + s.u.norm() + s.x.norm() + s.w.norm())) return s;
  }
  return std::nullopt;
}

}  // namespace irk::test
