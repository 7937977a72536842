#include "core/consistent_start.h"

#include <Eigen/LU>
#include <cmath>
#include <sstream>

#include "core/multiprecision.h"
#include "core/rate_lu.h"

namespace irk {
namespace {

// A start given with eight digits is a start; with fewer it is a mistake.
constexpr double kConstraintTolerance = 1e-7;
constexpr int kIterations = 25;

StartReport report(Outcome outcome, double t, Index row, const char* what, double value) {
  std::ostringstream text;
  text << "at the start, t = " << t << ": row " << row << ": " << what << " = " << value;
  if (outcome == Outcome::kInconsistentStart) text << ", allowed " << kConstraintTolerance;
  return {outcome, text.str()};
}

// x := D0^-1 x. False where D0 is singular; a dense one is asked with full pivoting.
template <class Real>
bool divide(const Linearization<Real>& D, RateLu<Real>& sparse, Vec<Real>& x) {
  if (D.pattern->full) {
    const Eigen::FullPivLU<Mat<Real>> lu(D.dense0());
    if (!lu.isInvertible()) return false;
    x = lu.solve(x).eval();
    return true;
  }
  if (sparse.factorize(D) != Outcome::kSuccess) return false;
  sparse.solve(x);
  return true;
}

}  // namespace

template <class Real>
StartReport makeConsistent(const System<Real>& system, DerivativeSource source, bool w_required,
                           State<Real>& state, StartCheck check) {
  using std::abs;
  const Sizes n = system.sizes();
  const double t = static_cast<double>(state.t);
  Vec<Real> r(n.n());
  const VecView<Real> rows(r.data(), n.n());
  const Index first = n.nu + n.nx;
  for (const Level level : {Level::kPosition, Level::kVelocity}) {
    system.evaluate(level, pointOf(state), rows);
    const Real size =
        Real(1) + state.u.template lpNorm<Eigen::Infinity>() +
        (level == Level::kVelocity ? state.v.template lpNorm<Eigen::Infinity>() : Real(0));
    for (Index i = 0; i < n.n(); ++i) {
      const double value = static_cast<double>(r[i]);
      if (!std::isfinite(value)) return report(Outcome::kNotFinite, t, i, "residual", value);
      const bool constraint = i >= first && i < first + n.constraints;
      if (constraint && check == StartCheck::kConstraints &&
          abs(r[i]) > Real(kConstraintTolerance) * size) {
        return report(Outcome::kInconsistentStart, t, i,
                      level == Level::kPosition ? "constraint g" : "constraint rate dg/dt", value);
      }
    }
  }

  Differentiator<Real> differentiator(system, source, JacobianTerms::kFull, Storage::kAutomatic,
                                      Matrices::kOnlyD0);
  Linearization<Real> D;
  RateLu<Real> sparse;
  const Vec<Real> given = state.w;
  Vec<Real> dw(n.n());
  const Real eps = Eigen::NumTraits<Real>::epsilon();
  for (int i = 0; i < kIterations; ++i) {
    system.evaluate(Level::kAcceleration, pointOf(state), rows);
    differentiator.evaluate(Level::kAcceleration, pointOf(state), D);
    if (!r.allFinite() || !D.d0.allFinite()) {
      return report(Outcome::kNotFinite, t, -1, "residual or derivative",
                    static_cast<double>(r.sum()));
    }
    dw = r;
    if (!divide(D, sparse, dw)) {
      state.w = given;
      system.evaluate(Level::kFormulated, pointOf(state), rows);
      Index worst = 0;
      const double value = static_cast<double>(Real(r.cwiseAbs().maxCoeff(&worst)));
      if (!w_required || value <= kConstraintTolerance) return {};
      return report(Outcome::kInconsistentStart, t, worst,
                    "accelerations cannot be determined (D0 is singular) and the given ones leave "
                    "the residual",
                    value);
    }
    state.w -= dw;
    if (dw.norm() <= Real(100) * eps * (Real(1) + state.w.norm())) return {};
  }
  // Linear problems end after two iterations; what is left at the level of the constraints'
  // tolerance serves as start values.
  system.evaluate(Level::kAcceleration, pointOf(state), rows);
  Index worst = 0;
  const double value = static_cast<double>(Real(r.cwiseAbs().maxCoeff(&worst)));
  const double size = 1 + static_cast<double>(Real(state.w.norm()));
  if (value <= kConstraintTolerance * size) return {};
  return report(Outcome::kInconsistentStart, t, worst,
                "Newton for consistent accelerations does not converge; residual", value);
}

template StartReport makeConsistent(const System<double>&, DerivativeSource, bool, State<double>&,
                                    StartCheck);
template StartReport makeConsistent(const System<mp50>&, DerivativeSource, bool, State<mp50>&,
                                    StartCheck);
template StartReport makeConsistent(const System<mp100>&, DerivativeSource, bool, State<mp100>&,
                                    StartCheck);

}  // namespace irk
