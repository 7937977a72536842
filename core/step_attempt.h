// A step with its error estimate: the strategies of the axis `estimate`.
#pragma once

#include <vector>

#include "core/stepper.h"

namespace irk {

struct AttemptResult : StepResult {
  double error = 0;  ///< estimate in the error norm; NaN without one
};

/// A solved step inside an attempt.
template <class Real>
struct StepPiece {
  const State<Real>* from;
  const StagePolynomial<Real>* stages;
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
  /// The parts of which the last solved step is made, in order: their starts and stages. Valid while
  /// `from` of the attempt is.
  virtual std::vector<StepPiece<Real>> pieces(const State<Real>& from) const = 0;
};

template <class Real>
std::unique_ptr<StepAttempt<Real>> makeStepAttempt(const System<Real>& system,
                                                   const Scheme<Real>& scheme,
                                                   const IntegratorOptions& options,
                                                   SharedJacobian<Real>& jacobian,
                                                   const ErrorNorm<Real>& norm,
                                                   Counters& counters);

}  // namespace irk
