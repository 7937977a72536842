#include "core/derivatives/consistent_start.h"

#include <cmath>
#include <limits>
#include <sstream>

#include "core/base/constants.h"
#include "core/derivatives/constraint_check.h"
#include "core/derivatives/constraint_frame.h"
#include "core/derivatives/derivative_fault.h"
#include "core/derivatives/weighted_changes.h"
#include "core/system/component_scale.h"
#include "core/system/counting.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

constexpr int kIterations = 50;
// The derivatives are kept while each correction is at most this part of the one before.
constexpr double kKeepBelow = 1e-3;
constexpr const char* kStart = "at the start";
constexpr const char* kConsistent = "consistent (a, k, z)";
// In a row before it is evaluated: one that a mode does not write would keep what an earlier mode has written.
template <class Real>
const Real kNotWritten(std::numeric_limits<double>::quiet_NaN());

StartReport report(Outcome outcome, const char* place, double t, Index row, const char* what, double value,
                   double allowed = 0) {
  std::ostringstream text;
  text << place << ", t = " << t << ": ";
  if (row >= 0) text << "row " << row << ": ";
  text << what << " = " << value;
  if (std::isnan(value)) text << " (not a number, or a row that the residual does not write)";
  if (allowed > 0) text << ", allowed " << allowed;
  return {outcome, text.str(), true};
}

// The first row that is not finite; if there is none, the row of the largest magnitude.
template <class Real>
Index worstRow(const Vec<Real>& r) {
  using std::abs;
  Index worst = 0;
  for (Index i = 0; i < r.size(); ++i) {
    if (!std::isfinite(static_cast<double>(r[i]))) return i;
    if (abs(r[i]) > abs(r[worst])) worst = i;
  }
  return worst;
}

}  // namespace

template <class Real>
ConsistentStart<Real>::ConsistentStart(const System<Real>& system, DerivativeSource source, bool w_required,
                                       Counters* counters, const Vec<double>& scale,
                                       std::shared_ptr<DifferentiatorScratch<Real>> scratch)
    : system_(system),
      source_(source),
      w_required_(w_required),
      counters_(counters),
      differentiator_(system, source, JacobianTerms::kFull, Storage::kAutomatic, Matrices::kOnlyD0, std::move(scratch)),
      r_(system.sizes().n()),
      dw_(system.sizes().n()),
      given_(system.sizes().n()),
      scale_(componentScale(system.sizes(), scale)) {}

// Returns false if D0 is singular. For a dense D0 this is decided by full pivoting of the scaled matrix.
template <class Real>
bool ConsistentStart<Real>::factorize() {
  ++factorizations_;
  if (!D_.pattern->full) return lu_.factorize(D_) == Outcome::kSuccess;
  scaled_ = D_.dense0();
  equilibration_.apply(*D_.pattern, scaled_.data());
  dense_lu_.compute(scaled_);
  return dense_lu_.isInvertible();
}

// dw_ = D0^-1 r_
template <class Real>
void ConsistentStart<Real>::solve() {
  if (D_.pattern->full) {
    // dense_lu_.solve(r_) without the memory that it takes: P (R D0 C) Q = L U.
    equilibration_.scaleRight(r_);
    dw_.noalias() = dense_lu_.permutationP() * r_;
    dense_lu_.matrixLU().template triangularView<Eigen::UnitLower>().solveInPlace(dw_);
    dense_lu_.matrixLU().template triangularView<Eigen::Upper>().solveInPlace(dw_);
    r_.noalias() = dense_lu_.permutationQ() * dw_;
    equilibration_.scaleBack(r_);
    dw_ = r_;
  } else {
    dw_ = r_;
    lu_.solve(dw_);
  }
}

// How much each component may be off. The rates a and k have the scales of v and x.
template <class Real>
State<double> ConsistentStart<Real>::weightsOf(const State<Real>& state) const {
  const Sizes n = system_.sizes();
  State<double> weights(n);
  const auto weigh = [](const auto& part, const auto& scale) -> Vec<double> {
    return kEightDigits * (scale + part.template cast<double>().cwiseAbs());
  };
  const Index rates = n.nu + n.nx;
  weights.u = weigh(state.u, scale_.head(n.nu));
  weights.v = weigh(state.v, scale_.segment(n.nu, n.nu));
  weights.x = weigh(state.x, scale_.segment(2 * n.nu, n.nx));
  weights.w << weigh(state.w.head(rates), scale_.segment(n.nu, rates)), weigh(state.z(), scale_.tail(n.nz));
  return weights;
}

// Those of (u, v, x).
template <class Real>
Vec<double> ConsistentStart<Real>::weightsOfMotion(const State<Real>& state) const {
  const State<double> weights = weightsOf(state);
  Vec<double> of_uvx(weights.carry.size());
  of_uvx << weights.u, weights.v, weights.x;
  return of_uvx;
}

// Says how many of the constraints are independent at the start; empty if all are.
template <class Real>
std::string ConsistentStart<Real>::dependentConstraints(const State<Real>& state) const {
  ConstraintFrames<Real> frames(uncounted(system_), scale_);
  if (frames.constraints() == 0) return {};
  ConstraintFrame frame = frames.make();
  frames.evaluate(state, state.t, frames.positions(state), frame);
  if (!frame.finite || frame.regular()) return {};
  std::ostringstream text;
  text << "the constraints have rank " << frame.rank << " of " << frames.constraints() << ' ' << kStart
       << ", t = " << sceneTime(system_, state.t);
  return text.str();
}

// Checks that all residuals are finite and that the constraints hold.
template <class Real>
StartReport ConsistentStart<Real>::checkConstraints(const State<Real>& state) {
  const auto t = [&] { return sceneTime(system_, state.t); };
  for (const Level level : {Level::kPosition, Level::kVelocity}) {
    r_.setConstant(kNotWritten<Real>);
    system_.evaluate(level, pointOf(state), VecView<Real>(r_.data(), r_.size()));
    for (Index i = 0; i < r_.size(); ++i) {
      const double value = static_cast<double>(r_[i]);
      if (!std::isfinite(value)) return report(Outcome::kNotFinite, kStart, t(), i, "residual", value);
    }
  }
  if (constrainedIn(system_).sizes().constraints == 0) return {};
  const std::string violated = constraintViolation<Real>(system_, state, weightsOfMotion(state), 1);
  if (violated.empty()) return {};
  return {Outcome::kInconsistentStart, std::string(kStart) + ": " + violated, true};
}

template <class Real>
StartReport ConsistentStart<Real>::apply(State<Real>& state, StartCheck check) {
  if (check == StartCheck::kConstraints) {
    StartReport checked = checkConstraints(state);
    if (checked.outcome != Outcome::kSuccess) return checked;
  }
  given_ = state.w;
  const bool at_start = check == StartCheck::kConstraints;
  const char* const place = at_start ? kStart : kConsistent;
  const std::int64_t before = factorizations_;
  StartReport found = determine(state, place, kEightDigits);
  if (counters_ && !at_start) counters_->mass_factorizations += factorizations_ - before;
  if (found.outcome != Outcome::kSuccess) state.w = given_;
  if (found.outcome != Outcome::kSingular) return found;
  if (check == StartCheck::kConstraints) {
    if (const std::string dependent = dependentConstraints(state); !dependent.empty()) {
      return {Outcome::kSingular, dependent, true};
    }
    const std::string violated = fixedRowViolation(system_, state, weightsOfMotion(state), 1);
    if (!violated.empty()) return {Outcome::kInconsistentStart, std::string(kStart) + ": " + violated, true};
  }
  return keep(state, place);
}

template <class Real>
StartReport ConsistentStart<Real>::findRates(State<Real>& state) {
  return determine(state, kConsistent, kEightDigits, Wanted::kRates);
}

template <class Real>
std::string ConsistentStart<Real>::applyAtEnd(State<Real>& state) {
  given_ = state.w;
  const StartReport found = determine(state, kConsistent, 0);
  if (found.outcome == Outcome::kSuccess) return {};
  state.w = given_;
  if (found.outcome == Outcome::kSingular) {
    return "z is that of the stages, (u, v, x) do not determine it: " + found.detail;
  }
  return "multipliers of the stages: " + found.detail;
}

// Newton's method for state.w. Returns kSingular if D0 is singular. If Newton does not converge, a residual up to
// `tolerated`, relative to 1 + |w|, is accepted.
template <class Real>
StartReport ConsistentStart<Real>::determine(State<Real>& state, const char* place, double tolerated, Wanted wanted) {
  const auto t = [&] { return sceneTime(system_, state.t); };
  const VecView<Real> rows(r_.data(), r_.size());
  const Real eps = Eigen::NumTraits<Real>::epsilon();
  Index worst = 0;
  double value = 0;
  const auto evaluate = [&] {
    r_.setConstant(kNotWritten<Real>);
    system_.evaluate(Level::kAcceleration, pointOf(state), rows);
    worst = worstRow(r_);
    value = static_cast<double>(r_[worst]);
    return std::isfinite(value);
  };
  const Real small = wanted == Wanted::kRates ? Real(kEightDigits.value) : Real(100) * eps;
  bool renew = wanted == Wanted::kAllDigits || !factorized_;
  Real before = renew ? Real(0) : Real(std::numeric_limits<double>::infinity());
  for (int i = 0; i < kIterations; ++i) {
    if (!evaluate()) break;
    if (renew) {
      factorized_ = false;
      if (counters_) ++counters_->jacobians;
      differentiator_.evaluate(Level::kAcceleration, pointOf(state), D_);
      if (!D_.d0.allFinite()) {
        std::ostringstream text;
        text << place << ", t = " << t() << ": " << derivativeFault(uncounted(system_), source_, state);
        return {Outcome::kNotFinite, text.str(), true};
      }
      factorized_ = factorize();
      if (!factorized_) {
        std::ostringstream text;
        text << "dr/d(a, k, z) is singular at t = " << t();
        return {Outcome::kSingular, text.str(), false};
      }
    }
    solve();
    const Real size = dw_.norm();
    // If kept derivatives contract badly, the correction is dropped and computed again with new derivatives.
    renew = !renew && size > Real(kKeepBelow) * before;
    if (renew) continue;
    before = size;
    state.w -= dw_;
    if (size <= small * (Real(1) + state.w.norm())) return {};
  }
  if (!evaluate()) return report(Outcome::kNotFinite, place, t(), worst, "residual", value);
  const double allowed = tolerated * (1 + static_cast<double>(Real(state.w.norm())));
  if (std::abs(value) <= allowed) return {};
  return report(Outcome::kInconsistentStart, place, t(), worst, "Newton does not converge; residual", value, allowed);
}

// Keeps the given (a, k, z) if they are not required or satisfy the residual.
template <class Real>
StartReport ConsistentStart<Real>::keep(const State<Real>& state, const char* place) {
  const auto residual = [this](const System<Real>& system, const State<Real>& at) {
    system.evaluate(Level::kFormulated, pointOf(at), VecView<Real>(r_.data(), r_.size()));
    return r_;
  };
  const Vec<Real> r = residual(system_, state);
  const double t = sceneTime(system_, state.t);
  const Index worst = worstRow(r);
  if (!std::isfinite(static_cast<double>(r[worst]))) {
    return report(Outcome::kNotFinite, place, t, worst, "residual", static_cast<double>(r[worst]));
  }
  if (!w_required_) return {Outcome::kSuccess, {}, false};
  const Vec<double> allowed = weightedChanges(state, weightsOf(state), r,
                                              [&](const State<Real>& at) { return residual(uncounted(system_), at); });
  for (Index i = 0; i < r.size(); ++i) {
    const double value = static_cast<double>(r[i]);
    if (std::abs(value) <= allowed[i]) continue;
    return report(Outcome::kInconsistentStart, place, t, i,
                  "accelerations cannot be determined (D0 is singular) and the given ones leave the residual", value,
                  allowed[i]);
  }
  return {Outcome::kSuccess, {}, false};
}

IRK_INSTANTIATE_CLASS(ConsistentStart)

}  // namespace irk
