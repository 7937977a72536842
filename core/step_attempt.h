// A step with its error estimate: the strategies of the axis `estimate`.
#pragma once

#include "core/stepper.h"

namespace irk {

struct AttemptResult : StepResult {
  double error = 0;  ///< estimate in the error norm; NaN without one
};

template <class Real>
class StepAttempt {
 public:
  virtual ~StepAttempt() = default;
  /// One step of size h from `from` to `to` (not aliased).
  [[nodiscard]] virtual AttemptResult attempt(const State<Real>& from, const Real& h,
                                              State<Real>& to) = 0;
  /// What was solved predicts badly: the attempt was not accepted, or the mode has changed.
  virtual void forget() = 0;
  /// The stages of the last whole step.
  virtual const StagePolynomial<Real>& stages() const = 0;
};

template <class Real>
std::unique_ptr<StepAttempt<Real>> makeStepAttempt(const System<Real>& system,
                                                   const Scheme<Real>& scheme,
                                                   const IntegratorOptions& options,
                                                   SharedJacobian<Real>& jacobian,
                                                   const ErrorNorm<Real>& norm,
                                                   Counters& counters);

}  // namespace irk
