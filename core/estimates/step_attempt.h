// A step with its error estimate: the strategies of the axis `estimate`.
#pragma once

#include <array>

#include "core/steps/stepper.h"

namespace irk {

struct AttemptResult : StepResult {
  /// Estimate in the error norm, accepted up to 1; NaN without one. Of variable order: times what is
  /// asked of the member.
  double error = 0;
  /// What an accepted step adds to the error of the result, in tolerances; 0 where it is far below the estimate.
  double added = 0;
};

/// What an accepted step means for the next one.
struct NextStep {
  double h;
  double error;  ///< that the accepted step would have had with the next step's order
};

/// A solved step inside an attempt.
template <class Real>
struct StepPiece {
  const State<Real>* from;
  const StagePolynomial<Real>* stages;
};

template <class Real>
struct StepPieces {
  std::array<StepPiece<Real>, 2> at;
  std::size_t count;
};

template <class Real>
class StepAttempt {
 public:
  virtual ~StepAttempt() = default;
  /// One step of size h from `from` to `to` (not aliased).
  [[nodiscard]] virtual AttemptResult attempt(const State<Real>& from, const Real& h,
                                              State<Real>& to) = 0;
  /// Resets all history: the next integration is bitwise that of a new object.
  virtual void begin() { forget(); }
  /// Forgets the last solved step, which is a bad prediction after a failure of Newton's method or a change of mode.
  /// (A step with too large an error is a good prediction of a shorter one.)
  virtual void forget() = 0;
  /// After a restart from a consistent (a, k): the first step has to follow them.
  virtual void restart() { forget(); }
  /// The step of size h that was attempted last is taken over, and the controller asks for h_next:
  /// the size of the next one, another where the order changes.
  virtual NextStep accepted(const AttemptResult& result, double h, double h_next) {
    static_cast<void>(h);
    return {h_next, result.error};
  }
  /// p of the estimate's leading error h^(p+1) in the next attempt.
  virtual int order() const = 0;
  /// The component of (u, v, x, z) with the largest error of the last solved step; -1 if not known.
  virtual Index worstComponent() const { return -1; }
  /// The parts of which the last solved step is made, in order: their starts and stages. Valid
  /// while `from` of the attempt is.
  virtual StepPieces<Real> pieces(const State<Real>& from) const = 0;
};

/// `error`, or a larger one whose leading term is h^q where the controller expects h^(p+1): so that its
/// step for h^(p+1) is the right one.
double worse(double error, int p, double other, int q);

/// 1 / (2^q - 1) per component (u, v, x, z): what the difference of one step and two halves is
/// multiplied by. q: the classical order for all (paper) or, with `richardson`, the component's
/// own: what its index (from the exponents of the error norm), the stage order and stiff accuracy
/// guarantee. HW II, table VII.4.1; Hairer, Lubich & Roche, LNM 1409.
template <class Real>
Vec<double> doublingFactors(const Scheme<Real>& scheme, const System<Real>& system,
                            ErrorEstimate estimate);

/// `schemes`: one or, with variable order, members of a family by ascending stages, of which
/// `start` is the first. Keeps references. Throws Misuse for an estimate that a scheme does not have.
template <class Real>
std::unique_ptr<StepAttempt<Real>> makeStepAttempt(const System<Real>& system,
                                                   const std::vector<Scheme<Real>>& schemes,
                                                   std::size_t start,
                                                   const IntegratorOptions& options,
                                                   SharedJacobian<Real>& jacobian,
                                                   const ErrorNorm<Real>& norm, Counters& counters);

}  // namespace irk
