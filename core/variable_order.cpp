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
// Newton's contraction above which no more stages are tried.
constexpr double kContractionToRaise = 0.1;
// What a step costs besides its stages, in stages: Jacobian, estimate, control.
constexpr double kOverhead = 2;
constexpr double kSafety = 0.9;

}  // namespace

template <class Real>
VariableOrder<Real>::VariableOrder(const System<Real>& system,
                                   const std::vector<Scheme<Real>>& schemes, std::size_t start,
                                   const IntegratorOptions& options,
                                   SharedJacobian<Real>& jacobian, const ErrorNorm<Real>& norm,
                                   Counters& counters)
    : at_(start), lower_error_(kUnknown) {
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
    result.outcome = estimate.outcome;
    lower_error_ = estimate.error * below.estimate.mu() / member().estimate.mu();
  }
  return result;
}

template <class Real>
void VariableOrder<Real>::forget() {
  for (auto& m : members_) m->stepper.forget();
  again_ = true;
}

// The step that the controller would like, per work.
template <class Real>
double VariableOrder<Real>::progress(double error, const Member& m, double h) const {
  const double factor = std::pow(std::max(error, 1e-300), -1.0 / (m.order + 1));
  return h * factor / (static_cast<double>(m.scheme.s) + kOverhead);
}

template <class Real>
double VariableOrder<Real>::accepted(const AttemptResult& result, double h, double h_next) {
  again_ = false;
  ++since_change_;
  if (std::isnan(lower_error_) && at_ > 0) return h_next;
  if (members_.size() == 1 || since_change_ < kLeastStay) return h_next;
  const double error = std::max(result.error, 1e-300);
  const double here = progress(error, member(), h);
  std::size_t best = at_;
  double best_progress = kGain * here, best_error = error;
  const auto consider = [&](std::size_t i, double e) {
    const double p = progress(e, *members_[i], h);
    if (p > best_progress) best = i, best_progress = p, best_error = e;
  };
  if (at_ > 0) consider(at_ - 1, lower_error_);
  if (at_ + 1 < members_.size() && result.theta < kContractionToRaise) {
    const Member& above = *members_[at_ + 1];
    const double stages = static_cast<double>(member().scheme.s);
    double ratio = 1;
    if (at_ > 0) {
      const double span = stages - static_cast<double>(members_[at_ - 1]->scheme.s);
      ratio = std::pow(std::min(error / lower_error_, 1.0), 1 / span);
    } else {
      ratio = 0.1;
    }
    const double more = static_cast<double>(above.scheme.s) - stages;
    consider(at_ + 1, error * std::pow(ratio, more) * above.estimate.mu() / member().estimate.mu());
  }
  if (best == at_) return h_next;
  changeTo(best);
  const double factor =
      kSafety * std::pow(best_error, -1.0 / (member().order + 1));
  return h * std::clamp(factor, 0.2, 8.0);
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
