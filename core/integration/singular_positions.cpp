#include "core/integration/singular_positions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "core/base/constants.h"
#include "core/system/component_scale.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

// The way is looked at in pieces in which the gradients turn by less than 30 degrees, so that one of them ends in the
// arc of 45 degrees in which the rest shows.
const double kNear = std::sqrt(0.75);
// A failed run looks ahead from this part of its largest step, by pieces that grow by a tenth.
constexpr double kFirstLook = 1e-3, kLooks = 1.1;

}  // namespace

template <class Real>
SingularPositions<Real>::SingularPositions(const System<Real>& system, const Vec<double>& scale)
    : frames_(system, scale),
      last_(frames_.make()),
      trial_(last_),
      start_(last_),
      scratch_(frames_.constraints(), frames_.constraints()),
      scale_(componentScale(system.sizes(), scale).head(last_.u.size())),
      u_(last_.u.size()) {}

template <class Real>
void SingularPositions<Real>::begin(const State<Real>& state) {
  largest_ = 0;
  restart(state);
}

template <class Real>
void SingularPositions<Real>::restart(const State<Real>& state) {
  found_.clear();
  u_ = frames_.positions(state);
  frames_.evaluate(state, state.t, u_, last_);
  start_ = last_;
  watches_ = last_.regular();
  far_ = 0;
  seen_ = 0;
}

template <class Real>
double SingularPositions<Real>::distance(const ConstraintFrame& from, ConstVec<Real> u) const {
  double sum = 0;
  for (Index j = 0; j < u.size(); ++j) {
    const double moved = (static_cast<double>(u[j]) - from.u[j]) / scale_[j];
    sum += moved * moved;
  }
  return std::sqrt(sum);
}

// Makes trial_ the last frame, and tells from its change how far the next one may be.
template <class Real>
void SingularPositions<Real>::keep() {
  if (!trial_.finite) return;
  const double moved = distance(last_, {u_.data(), u_.size()});
  const double turn = std::acos(std::clamp(turned(last_, trial_, scratch_), -1.0, 1.0));
  double part = std::acos(kNear) / turn;  // infinite if nothing has turned
  for (Index i = 0; i < last_.R.cols(); ++i) {
    part = std::min(part, trial_.R(i, i) / std::abs(trial_.R(i, i) - last_.R(i, i)));
  }
  far_ = moved > 0 ? moved * part / 2 : 0;
  std::swap(last_, trial_);
}

// A dependence that begins between two states is a singular position, too: a motion can end on it.
template <class Real>
bool SingularPositions<Real>::isSingular(const ConstraintFrame& frame) {
  if (!frame.finite) return false;
  return !frame.regular() || frames_.newtonRest(frame) >= kNewtonRest;
}

template <class Real>
bool SingularPositions<Real>::isNear(const ConstraintFrame& a, const ConstraintFrame& b) {
  return !b.finite || turned(a, b, scratch_) >= kNear;
}

// Sets u_ to the positions at from.t + theta h: cubic Hermite interpolation, exact at theta = 1.
template <class Real>
void SingularPositions<Real>::move(const State<Real>& from, const State<Real>& to, double theta) {
  const auto u0 = frames_.positions(from), u1 = frames_.positions(to);
  const auto v0 = frames_.velocities(from), v1 = frames_.velocities(to);
  const Real s(theta), h = to.t - from.t;
  const Real left = Real(1) - s;
  for (Index j = 0; j < u_.size(); ++j) {
    const Real ends = left * left * (Real(1) + Real(2) * s) * u0[j] + s * s * (Real(3) - Real(2) * s) * u1[j];
    u_[j] = ends + h * s * left * (left * v0[j] - s * v1[j]);
  }
}

template <class Real>
bool SingularPositions<Real>::passes(const SharedJacobian<Real>& jacobian, const State<Real>& from,
                                     const State<Real>& to) {
  largest_ = std::max(largest_, static_cast<double>(Real(to.t - from.t)));
  if (!watches_) return false;
  const bool kept = !jacobian.stale() && jacobian.version() == seen_;
  if (kept && distance(last_, frames_.positions(to)) < far_) return false;
  seen_ = jacobian.version();
  return lookAlong(from, to);
}

template <class Real>
bool SingularPositions<Real>::explains(Outcome outcome, const State<Real>& state) {
  if (outcome == Outcome::kSingular && !found_.empty()) return true;
  const bool could_not_go_on = isRecoverable(outcome) || outcome == Outcome::kStepTooSmall ||
                               outcome == Outcome::kStalled || outcome == Outcome::kMaxSteps;
  return watches_ && could_not_go_on && liesAhead(state);
}

template <class Real>
bool SingularPositions<Real>::lookAlong(const State<Real>& from, const State<Real>& to) {
  const double t = std::abs(static_cast<double>(to.t)), h = static_cast<double>(Real(to.t - from.t));
  // Shorter pieces end in the round-off of positions, where gradients point anywhere.
  constexpr double kEps = std::numeric_limits<double>::epsilon(), kUnits = 1e4;
  const double shortest = std::max(std::sqrt(kEps), kUnits * kEps * t / h);
  double at = 0, next = 1;
  const auto look = [&](double theta) {
    move(from, to, theta);
    frames_.evaluate(from, from.t + Real(theta) * (to.t - from.t), u_, trial_);
    return isSingular(trial_) && report(trial_);
  };
  bool begun = false;  // whether last_ is on the way of this step: steps before it may have been left out
  while (at < 1) {
    if (look(next)) return true;
    if (isNear(last_, trial_)) {
      const double piece = next - at;
      keep();
      begun = true;
      at = next;
      next = std::min(1.0, at + 2 * piece);
    } else if (!begun) {
      if (look(0)) return true;
      if (trial_.finite && turned(last_, trial_, scratch_) < 0) return report(trial_);
      keep();
      begun = true;
    } else if (next - at <= shortest) {
      return report(trial_);
    } else {
      next = at + (next - at) / 2;
    }
  }
  return false;
}

// A straight way along which the gradients turn by more than a right angle within a tenth of its length leads past a
// singular position: a regular constraint is nearly flat there.
template <class Real>
bool SingularPositions<Real>::liesAhead(const State<Real>& state) {
  u_ = frames_.positions(state);
  const auto v = frames_.velocities(state);
  frames_.evaluate(state, state.t, u_, trial_);
  if (isSingular(trial_)) return report(trial_);
  for (double ahead = kFirstLook * largest_; ahead < kLooks * largest_; ahead *= kLooks) {
    std::swap(last_, trial_);
    for (Index j = 0; j < u_.size(); ++j) u_[j] = frames_.positions(state)[j] + Real(ahead) * v[j];
    frames_.evaluate(state, state.t + Real(ahead), u_, trial_);
    if (trial_.finite && !trial_.regular()) return report(trial_);
    if (trial_.finite && last_.finite && turned(last_, trial_, scratch_) < 0) return report(trial_);
  }
  return false;
}

template <class Real>
bool SingularPositions<Real>::report(const ConstraintFrame& at) {
  std::ostringstream text;
  text.precision(10);
  text << "singular position at t = " << at.t
       << ": the gradients of the constraints become dependent, that of constraint " << frames_.weakest(at, start_)
       << " (from 0 on) the most, and the motion beyond is not determined";
  found_ = text.str();
  return true;
}

IRK_INSTANTIATE_CLASS(SingularPositions)

}  // namespace irk
