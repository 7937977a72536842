// A step with its error estimate: the strategies of the axis `estimate`.
#pragma once

#include "core/stepper.h"

namespace irk {

struct AttemptResult {
  Outcome outcome = Outcome::kSuccess;
  double error = 0;  ///< estimate in the error norm; NaN without one
  int newton_iterations = 0;
};

template <class Real>
class StepAttempt {
 public:
  virtual ~StepAttempt() = default;
  /// One step of size h from `from` to `to` (not aliased).
  [[nodiscard]] virtual AttemptResult attempt(const State<Real>& from, const Real& h,
                                              State<Real>& to) = 0;
  /// The last attempt was not accepted.
  virtual void rejected() = 0;
};

template <class Real>
std::unique_ptr<StepAttempt<Real>> makeStepAttempt(const System<Real>& system,
                                                   const Scheme<Real>& scheme,
                                                   const IntegratorOptions& options,
                                                   SharedJacobian<Real>& jacobian,
                                                   const ErrorNorm<Real>& norm,
                                                   Counters& counters);

}  // namespace irk
