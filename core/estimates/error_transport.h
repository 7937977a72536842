// The error of the result, carried from step to step: the linearized flow of each step applied to the error at its
// start, plus the error that the step adds.
#pragma once

#include "core/stages/error_norm.h"
#include "core/steps/stepper.h"

namespace irk {

/// E = computed - exact, to first order: E_1 = A E_0 + e. A is the linearized step, e the estimated local error. Unlike
/// a sum of norms, E grows where the motion amplifies errors and decays where the method damps them, and errors of
/// opposite signs cancel. A E_0 usually costs two iterations of Newton's method with the factors of the step. Transport
/// of local errors: Hairer, Norsett & Wanner, Solving ODEs I (II.3). E stays as it is at a switch, though a jump of the
/// velocity turns it. It is unknown from a step on whose corrections do not contract. Allocates in its constructor
/// only.
template <class Real>
class ErrorTransport {
 public:
  ErrorTransport(const Sizes& sizes, Index stages);

  /// A new integration: the error at the start is zero.
  void begin();
  /// After a restart, which has computed (a, k, z) anew from (u, v, x).
  void restart() { error_.w.setZero(); }
  /// Computes the error at the end of the step from `from` that `stepper` has solved last. `whole` is its end, `fine`
  /// the end that is kept, with the local error factor (whole - fine) in each component. `norm` has the weights at
  /// `from`.
  void carry(Stepper<Real>& stepper, const State<Real>& from, const State<Real>& whole, const State<Real>& fine,
             const Vec<double>& factor, const ErrorNorm<Real>& norm);
  /// The step of the last `carry` was accepted.
  void accept() {
    error_ = next_;
    lost_ = lost_ || loses_;
    sum_ += added_;
  }

  /// The largest error of a component of (u, v, x) after the accepted steps, in units of the norm's weights, which are
  /// tolerances; NaN if it is unknown.
  double size(const ErrorNorm<Real>& norm) const;
  /// How often the error is larger than the sum of the errors that the accepted steps have added: the amplification by
  /// the motion. 0 before the first error.
  double amplification(const ErrorNorm<Real>& norm) const;

 private:
  Sizes sizes_;
  double sizeOf(const State<Real>& error, const ErrorNorm<Real>& norm) const;

  State<Real> error_, next_, start_, end_, local_;
  double sum_ = 0, added_ = 0;  // of the errors of the accepted steps; of the step of the last `carry`
  StepCorrection<Real> scratch_;
  bool lost_ = false, loses_ = false;  // the error is unknown; it is after the step of the last `carry`
};

}  // namespace irk
