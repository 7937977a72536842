// One step of the scheme: predict, solve, finish.
#pragma once

#include <memory>

#include "core/newton.h"
#include "core/predictor.h"

namespace irk {

/// Attempts steps; keeps the stages of its last solved step. Owns all scratch of a step. A failed
/// attempt leaves `to` and the stage polynomial unspecified but `from` untouched.
template <class Real>
class Stepper {
 public:
  Stepper(const System<Real>& system, const Scheme<Real>& scheme,
          const IntegratorOptions& options, SharedJacobian<Real>& jacobian,
          const ErrorNorm<Real>& norm, Counters& counters);

  /// One step [from.t, from.t + h] with start values from `past` (may be this stepper's own).
  [[nodiscard]] NewtonResult attempt(const StagePolynomial<Real>& past, const State<Real>& from,
                                     const Real& h, State<Real>& to,
                                     JacobianUse use = JacobianUse::kRefreshIfStale);

  const StagePolynomial<Real>& stages() const { return stages_; }
  /// Forget the solved step: after a rejection or a discontinuity it predicts badly.
  void forget() { stages_.valid = false; }

 private:
  Counters& counters_;
  StageEquations<Real> eq_;
  NewtonMatrix<Real> matrix_;
  StagewiseMatrix<Real> stagewise_;
  std::unique_ptr<Newton<Real>> newton_;
  const ErrorNorm<Real>& norm_;
  StartValues<Real> start_values_;
  StagePolynomial<Real> stages_;
  Mat<Real> W_;
};

}  // namespace irk
