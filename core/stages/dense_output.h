// The solution inside a step: the stages' polynomial, integrated in the Legendre basis.
#pragma once

#include "core/stages/start_values.h"

namespace irk {

/// u, v, x, w at t + theta h from the stages W (n x s) of a solved step. W V^-T are the coefficients
/// of w = sum_k C_k P_k(theta); v and x integrate them once, u twice. Stable for any s. Order: that
/// of the polynomial (s), not that of the step's end. Owns scratch.
template <class Real>
class DenseOutput {
 public:
  explicit DenseOutput(const Sizes& sizes);

  /// For the step from `from` with the stages `past`; both must outlive the evaluations.
  void begin(const State<Real>& from, const StagePolynomial<Real>& past);
  /// theta in [0, 1]; writes t, u, v, x, w; d is that of `from`.
  void evaluate(const Real& theta, State<Real>& out);
  /// The same at theta = j / kParts, 0 < j < kParts: all of a step in three products with the scheme's
  /// weights.
  void evaluateInside(Index j, State<Real>& out);

 private:
  template <class W, class Once, class Twice>
  void write(const Real& theta, const W& w, const Once& once, const Twice& twice,
             State<Real>& out) const;

  const State<Real>* from_ = nullptr;
  const StagePolynomial<Real>* past_ = nullptr;
  Index nu_, nx_;
  bool expanded_ = false, inside_ = false;  // done for past_: C_; w_, once_, twice_
  Mat<Real> C_;                             // n x s, s that of the step
  Vec<Real> p_, integral_, second_;         // P_0 .. P_{s+1} at theta, their integrals
  // At theta, and at all inside points: w, its integral, and that of a once more.
  Vec<Real> w_at_, once_at_, twice_at_;
  Mat<Real> w_, once_, twice_;  // n, nu + nx, nu rows
};

}  // namespace irk
