#include "core/consistent_start.h"

#include <Eigen/LU>
#include <cmath>
#include <sstream>

#include "core/multiprecision.h"

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

}  // namespace

template <class Real>
ConsistentStart<Real>::ConsistentStart(const System<Real>& system, DerivativeSource source,
                                       bool w_required)
    : system_(system),
      w_required_(w_required),
      differentiator_(system, source, JacobianTerms::kFull, Storage::kAutomatic,
                      Matrices::kOnlyD0),
      r_(system.sizes().n()),
      dw_(system.sizes().n()),
      given_(system.sizes().n()) {}

// dw := D0^-1 dw. False where D0 is singular; a dense one is asked with full pivoting.
template <class Real>
bool ConsistentStart<Real>::divide() {
  if (D_.pattern->full) {
    const Eigen::FullPivLU<Mat<Real>> lu(D_.dense0());
    if (!lu.isInvertible()) return false;
    dw_ = lu.solve(dw_).eval();
    return true;
  }
  if (lu_.factorize(D_) != Outcome::kSuccess) return false;
  lu_.solve(dw_);
  return true;
}

// g = 0, dg/dt = 0, and nothing that is not finite.
template <class Real>
StartReport ConsistentStart<Real>::checkConstraints(const State<Real>& state, StartCheck check) {
  using std::abs;
  const Sizes n = system_.sizes();
  const double t = static_cast<double>(state.t);
  const VecView<Real> rows(r_.data(), n.n());
  const Index first = n.nu + n.nx;
  for (const Level level : {Level::kPosition, Level::kVelocity}) {
    system_.evaluate(level, pointOf(state), rows);
    const Real size =
        Real(1) + state.u.template lpNorm<Eigen::Infinity>() +
        (level == Level::kVelocity ? state.v.template lpNorm<Eigen::Infinity>() : Real(0));
    for (Index i = 0; i < n.n(); ++i) {
      const double value = static_cast<double>(r_[i]);
      if (!std::isfinite(value)) return report(Outcome::kNotFinite, t, i, "residual", value);
      const bool constraint = i >= first && i < first + n.constraints;
      if (constraint && check == StartCheck::kConstraints &&
          abs(r_[i]) > Real(kConstraintTolerance) * size) {
        return report(Outcome::kInconsistentStart, t, i,
                      level == Level::kPosition ? "constraint g" : "constraint rate dg/dt", value);
      }
    }
  }
  return {};
}

template <class Real>
StartReport ConsistentStart<Real>::apply(State<Real>& state, StartCheck check) {
  const StartReport checked = checkConstraints(state, check);
  if (checked.outcome != Outcome::kSuccess) return checked;
  const double t = static_cast<double>(state.t);
  const VecView<Real> rows(r_.data(), r_.size());
  given_ = state.w;
  const Real eps = Eigen::NumTraits<Real>::epsilon();
  for (int i = 0; i < kIterations; ++i) {
    system_.evaluate(Level::kAcceleration, pointOf(state), rows);
    differentiator_.evaluate(Level::kAcceleration, pointOf(state), D_);
    if (!r_.allFinite() || !D_.d0.allFinite()) {
      return report(Outcome::kNotFinite, t, -1, "residual or derivative",
                    static_cast<double>(r_.sum()));
    }
    dw_ = r_;
    if (!divide()) {
      state.w = given_;
      system_.evaluate(Level::kFormulated, pointOf(state), rows);
      Index worst = 0;
      const double value = static_cast<double>(Real(r_.cwiseAbs().maxCoeff(&worst)));
      if (!w_required_ || value <= kConstraintTolerance) return {};
      return report(Outcome::kInconsistentStart, t, worst,
                    "accelerations cannot be determined (D0 is singular) and the given ones leave "
                    "the residual",
                    value);
    }
    state.w -= dw_;
    if (dw_.norm() <= Real(100) * eps * (Real(1) + state.w.norm())) return {};
  }
  // Linear problems end after two iterations; what is left at the level of the constraints'
  // tolerance serves as start values.
  system_.evaluate(Level::kAcceleration, pointOf(state), rows);
  Index worst = 0;
  const double value = static_cast<double>(Real(r_.cwiseAbs().maxCoeff(&worst)));
  const double size = 1 + static_cast<double>(Real(state.w.norm()));
  if (value <= kConstraintTolerance * size) return {};
  return report(Outcome::kInconsistentStart, t, worst,
                "Newton for consistent accelerations does not converge; residual", value);
}

IRK_INSTANTIATE_CLASS(ConsistentStart)

}  // namespace irk
