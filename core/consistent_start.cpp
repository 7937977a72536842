#include "core/consistent_start.h"

#include <cmath>
#include <sstream>

#include "core/multiprecision.h"

namespace irk {
namespace {

// A start given with eight digits is a start; with fewer it is a mistake.
constexpr double kConstraintTolerance = 1e-7;
constexpr int kIterations = 25;
// The derivatives serve on while the corrections contract at least so much.
constexpr double kKeepBelow = 1e-3;

StartReport report(Outcome outcome, double t, Index row, const char* what, double value) {
  std::ostringstream text;
  text << "a consistent state at t = " << t << ": ";
  if (row >= 0) text << "row " << row << ": ";
  text << what << " = " << value;
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

// False where D0 is singular; a dense one is asked with full pivoting.
template <class Real>
bool ConsistentStart<Real>::factorize() {
  if (!D_.pattern->full) return lu_.factorize(D_) == Outcome::kSuccess;
  dense_lu_.compute(D_.dense0());
  return dense_lu_.isInvertible();
}

// dw = D0^-1 r
template <class Real>
void ConsistentStart<Real>::solve() {
  if (D_.pattern->full) {
    dw_.noalias() = dense_lu_.solve(r_);
  } else {
    dw_ = r_;
    lu_.solve(dw_);
  }
}

// g = 0, dg/dt = 0, and nothing that is not finite.
template <class Real>
StartReport ConsistentStart<Real>::checkConstraints(const State<Real>& state) {
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
      if (constraint && abs(r_[i]) > Real(kConstraintTolerance) * size) {
        return report(Outcome::kInconsistentStart, t, i,
                      level == Level::kPosition ? "constraint g" : "constraint rate dg/dt", value);
      }
    }
  }
  return {};
}

template <class Real>
StartReport ConsistentStart<Real>::apply(State<Real>& state, StartCheck check) {
  if (check == StartCheck::kConstraints) {
    const StartReport checked = checkConstraints(state);
    if (checked.outcome != Outcome::kSuccess) return checked;
  }
  const double t = static_cast<double>(state.t);
  const VecView<Real> rows(r_.data(), r_.size());
  given_ = state.w;
  const Real eps = Eigen::NumTraits<Real>::epsilon();
  Real size(0);
  bool renew = true;
  for (int i = 0; i < kIterations; ++i) {
    system_.evaluate(Level::kAcceleration, pointOf(state), rows);
    if (renew) differentiator_.evaluate(Level::kAcceleration, pointOf(state), D_);
    for (Index row = 0; row < r_.size(); ++row) {
      const double value = static_cast<double>(r_[row]);
      if (!std::isfinite(value)) return report(Outcome::kNotFinite, t, row, "residual", value);
    }
    if (!D_.d0.allFinite()) {
      return report(Outcome::kNotFinite, t, -1, "derivative by (a, k, z)",
                    static_cast<double>(D_.d0.sum()));
    }
    if (renew && !factorize()) {
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
    solve();
    state.w -= dw_;
    const Real before = size;
    size = dw_.norm();
    if (size <= Real(100) * eps * (Real(1) + state.w.norm())) return {};
    // The first iteration solves what is linear in w; else it is Newton's from the third on.
    renew = i > 0 && size > Real(kKeepBelow) * before;
  }
  // Linear problems end after two iterations; what is left at the level of the constraints'
  // tolerance serves as start values.
  system_.evaluate(Level::kAcceleration, pointOf(state), rows);
  Index worst = 0;
  const double value = static_cast<double>(Real(r_.cwiseAbs().maxCoeff(&worst)));
  if (value <= kConstraintTolerance * (1 + static_cast<double>(Real(state.w.norm())))) return {};
  return report(Outcome::kInconsistentStart, t, worst,
                "Newton for consistent accelerations does not converge; residual", value);
}

IRK_INSTANTIATE_CLASS(ConsistentStart)

}  // namespace irk
