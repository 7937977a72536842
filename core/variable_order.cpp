#include "core/variable_order.h"

#include <algorithm>
#include <cmath>

#include "core/multiprecision.h"

namespace irk {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
// Accepted steps between two changes of the order.
constexpr int kLeastStay = 3;
// Progress per work must grow by this factor: new factors, worse start values.
constexpr double kGain = 1.1;
// Newton's contraction: a step beyond the upper bound is not planned.
constexpr double kLeastContraction = 1e-4, kMostContraction = 0.3;
// What a step costs besides its stages: Jacobian, estimate, control.
constexpr double kOverhead = 6;
constexpr double kSafety = 0.9, kShrinkAtMost = 0.2, kGrowAtMost = 8, kTinyError = 1e-300;
// Stages at which a Newton iteration's transformations cost as much as its residuals and solves.
constexpr double kTransform = 16;

}  // namespace

template <class Real>
VariableOrder<Real>::VariableOrder(const System<Real>& system,
                                   const std::vector<Scheme<Real>>& schemes, std::size_t start,
                                   const IntegratorOptions& options,
                                   SharedJacobian<Real>& jacobian, const ErrorNorm<Real>& norm,
                                   Counters& counters)
    : start_(start),
      at_(start),
      lower_error_(kUnknown),
      unknowns_(static_cast<double>(system.sizes().n())) {
  for (const auto& scheme : schemes) {
    members_.push_back(
        std::make_unique<Member>(system, scheme, options, jacobian, norm, counters));
  }
  past_ = &member().stepper.stages();
}

template <class Real>
AttemptResult VariableOrder<Real>::attempt(const State<Real>& from, const Real& h,
                                           State<Real>& to) {
  AttemptResult result{member().stepper.attempt(*past_, from, h, to), 0};
  if (result.outcome != Outcome::kSuccess) return result;
  past_ = &member().stepper.stages();
  auto estimate = member().estimate.evaluate(from, *past_, again_);
  result.outcome = estimate.outcome;
  result.error = std::max(estimate.error, result.mode_error);
  lower_error_ = kUnknown;
  if (result.outcome == Outcome::kSuccess && result.error <= 1 && at_ > 0 &&
      since_change_ + 1 >= kLeastStay) {
    const Member& below = *members_[at_ - 1];
    estimate = member().estimate.evaluateLower(from, *past_, below.scheme.s);
    // Where it cannot be computed the order stays; the step is good.
    if (estimate.outcome == Outcome::kSuccess) {
      lower_error_ = estimate.error * below.estimate.mu() / member().estimate.mu();
    }
  }
  again_ = !(result.error <= 1);
  return result;
}

template <class Real>
void VariableOrder<Real>::begin() {
  changeTo(start_);
  past_ = &member().stepper.stages();
  forget();
}

template <class Real>
void VariableOrder<Real>::forget() {
  for (auto& m : members_) m->stepper.forget();
  again_ = true;
  lower_error_ = kUnknown;
}

// The step that the member would take next, and its progress per work.
template <class Real>
auto VariableOrder<Real>::plan(double error, const Member& m, const AttemptResult& now, double h,
                               double trend) const -> Plan {
  const double s = static_cast<double>(m.scheme.s);
  const double wish =
      kSafety * trend * std::pow(std::max(error, kTinyError), -1.0 / (m.order + 1));
  const double ratio = std::clamp(wish, kShrinkAtMost, kGrowAtMost);
  Plan plan{h * ratio, error, 0};
  // Newton's contraction grows with the step.
  const double before = std::max(now.theta, kLeastContraction);
  const double theta = before * ratio;
  if (theta > kMostContraction) return plan;
  const double decades = now.newton_iterations * std::log(1 / before);
  const double iterations =
      now.theta > 0 ? std::max(1.0, decades / std::log(1 / theta)) : now.newton_iterations;
  const double work = iterations * s * (1 + s / kTransform) + s * (1 + unknowns_ / 8) + kOverhead;
  plan.progress = plan.h / work;
  return plan;
}

template <class Real>
NextStep VariableOrder<Real>::accepted(const AttemptResult& result, double h, double h_next) {
  ++since_change_;
  if (std::isnan(lower_error_) && at_ > 0) return {h_next, result.error};
  if (members_.size() == 1 || since_change_ < kLeastStay) return {h_next, result.error};
  const double error = std::max(result.error, kTinyError);
  // What the controller has learnt of the error's trend holds for all members.
  const double untrended = h * kSafety * std::pow(error, -1.0 / (member().order + 1));
  const double trend = std::min(1.0, h_next / untrended);
  Plan best = plan(error, member(), result, h, trend);
  best.progress *= kGain;
  std::size_t next = at_;
  const auto consider = [&](std::size_t i, double e) {
    const Plan p = plan(e, *members_[i], result, h, trend);
    if (p.progress > best.progress) next = i, best = p;
  };
  if (at_ > 0) consider(at_ - 1, lower_error_);
  if (at_ + 1 < members_.size()) {
    const Member& above = *members_[at_ + 1];
    const double s = static_cast<double>(member().scheme.s);
    const double below = at_ > 0 ? static_cast<double>(members_[at_ - 1]->scheme.s) : s - 1;
    const double ratio = at_ > 0 ? std::min(error / lower_error_, 1.0) : 0.1;
    const double more = (static_cast<double>(above.scheme.s) - s) / (s - below);
    consider(at_ + 1, error * std::pow(ratio, more) * above.estimate.mu() / member().estimate.mu());
  }
  if (next == at_) return {h_next, result.error};
  changeTo(next);
  return {best.h, best.error};
}

template <class Real>
void VariableOrder<Real>::changeTo(std::size_t next) {
  at_ = next;
  since_change_ = 0;
}

template <class Real>
void VariableOrder<Real>::failed(double) {
  again_ = true;
  if (at_ > 0) changeTo(at_ - 1);
}

template <class Real>
int VariableOrder<Real>::order() const {
  return member().order;
}

IRK_INSTANTIATE_CLASS(VariableOrder)

}  // namespace irk
