// How far the end of an integration is off the slow motion of stiff components.
#pragma once

#include "core/estimates/step_attempt.h"
#include "core/newton/newton_matrix.h"
#include "core/stages/error_norm.h"

namespace irk {

/// A method with |R(infinity)| = 1 carries errors of stiff components from step to step without damping them. Every
/// step keeps its tolerance, and they add up unseen: the halves of a step carry what the whole step carries. But there
/// the rates at the end of a step are off those of its stages by the error times a large eigenvalue, so that one look
/// at the end of the integration finds it. Owns scratch and a factorization of its own; keeps references.
template <class Real>
class StiffRest {
 public:
  StiffRest(const System<Real>& system, const IntegratorOptions& options, SharedJacobian<Real>& jacobian,
            const ErrorNorm<Real>& norm, Counters& counters);

  /// Of the state `end` of the solved step `last`, in tolerances: the parts of
  ///   e = -(D0 + d D1 + d^2 D2)^-1 d r(t; end; K),  K: the stages' polynomial at the end,  d: a hundredth of the step,
  /// whose eigenvalues are large against 1 / d. They are what remains of e when it is filtered again and again. 0 where
  /// it cannot be computed.
  double error(const StepPiece<Real>& last, const State<Real>& end);
  /// The component of (u, v, x) with the largest part in it.
  Index worstComponent() const;

 private:
  bool filter(const Real& d);

  const System<Real>& system_;
  const ErrorNorm<Real>& norm_;
  Sizes sizes_;
  NewtonMatrix<Real> matrix_;
  State<Real> at_, change_, rest_;
  Vec<Real> slip_;     // d (v - V) at the end, V: the velocity by the polynomial
  Vec<Real> weights_;  // of the stages' accelerations in V
  Mat<Real> e_;
};

}  // namespace irk
