// Measures how far the end of an integration is from the slow motion of stiff components.
#pragma once

#include "core/estimates/step_attempt.h"
#include "core/newton/newton_matrix.h"
#include "core/stages/error_norm.h"

namespace irk {

/// A method with |R(infinity)| = 1 does not damp errors of stiff components from step to step. Every step keeps its
/// tolerance, but the errors add up, and no estimate shows it: the halves of a step have the same error as the whole
/// step. At the end of a step, however, the rates differ from those of its stages by the error times a large
/// eigenvalue, so that one evaluation at the end of the integration shows the error. Owns scratch and a factorization
/// of its own; keeps references.
template <class Real>
class StiffRest {
 public:
  StiffRest(const System<Real>& system, const IntegratorOptions& options, SharedJacobian<Real>& jacobian,
            const ErrorNorm<Real>& norm, Counters& counters);

  /// For the state `end` of the solved step `last`, in tolerances: the part of
  ///   e = -(D0 + d D1 + d^2 D2)^-1 d r(t; end; K),  K: the stages' polynomial at the end,  d: a hundredth of the step,
  /// that belongs to eigenvalues large against 1 / d. It is the part that remains of e after repeated filtering. 0 if
  /// it cannot be computed.
  double error(const StepPiece<Real>& last, const State<Real>& end);
  /// The component of (u, v, x) with the largest part in the error.
  Index worstComponent() const;

 private:
  bool filter(const Real& d);

  const System<Real>& system_;
  const ErrorNorm<Real>& norm_;
  Sizes sizes_;
  NewtonMatrix<Real> matrix_;
  State<Real> at_, change_, rest_;
  Vec<Real> slip_;     // d (v - V) at the end, with V the velocity of the polynomial
  Vec<Real> weights_;  // weights of the stages' accelerations in V
  Mat<Real> e_;
};

}  // namespace irk
