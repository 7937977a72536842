#include "core/modes/switch_effect.h"

#include <algorithm>
#include <limits>

namespace irk {

template <class Real>
SwitchEffect<Real>::SwitchEffect(const System<Real>& system, const IntegratorOptions& options,
                                 const ErrorNorm<Real>& norm, Counters& counters)
    : norm_(norm),
      functions_(system),
      scan_(system),
      consistent_(system, options.derivatives, false, &counters),
      rate_norm_(system.sizes(), norm),
      inside_(system.sizes()),
      rates_(system.sizes().n()),
      ones_(Vec<double>::Ones(system.sizes().components())) {}

template <class Real>
bool SwitchEffect<Real>::dueInside(const SolvedStep<Real>& step, const State<Real>& end, Index& index) {
  const auto due = scan_.first(step.from, step.stages, end);
  if (scan_.report().outcome != Outcome::kSuccess) index = scan_.report().index;
  if (!due.empty()) {
    index = due.front().index;
    inside_ = scan_.at(due.front().high);
    return true;
  }
  // A switch can be due at a stage between two samples.
  const Scheme<Real>& scheme = step.eq.scheme();
  for (Index i = scheme.first; i < scheme.s && index < 0; ++i) {
    const SwitchReport report = functions_.evaluate(step.eq.stage(step.stages.W, i));
    index = report.outcome == Outcome::kSuccess ? functions_.due() : report.index;
    if (index >= 0) inside_ = scan_.at(scheme.c[i]);
  }
  return index >= 0;
}

template <class Real>
double SwitchEffect<Real>::changeOfRates(const Real& h) {
  rates_ = inside_.w;
  const StartReport report = consistent_.apply(inside_, StartCheck::kNone);
  // If the effect cannot be determined, the step must not be accepted.
  if (report.outcome != Outcome::kSuccess) return std::numeric_limits<double>::infinity();
  rates_ -= inside_.w;
  return rate_norm_(rates_, h);
}

template <class Real>
double SwitchEffect<Real>::difference(const State<Real>& p, const State<Real>& q, const Real& h) const {
  return norm_.difference(p, q, static_cast<double>(h), ones_);
}

template <class Real>
double SwitchEffect<Real>::changeInStep(const SolvedStep<Real>& step, const State<Real>& before) {
  double most = rate_norm_.largestChange(step.stages.W, step.from.w, step.h);
  most = std::max(most, difference(before, step.to, step.h));
  inside_ = step.to;
  return std::max(most, changeOfRates(step.h));
}

IRK_INSTANTIATE_CLASS(SwitchEffect)

}  // namespace irk
