// Dense output: the solution inside a step, by integration of the polynomial through the stages.
#pragma once

#include "core/stages/start_values.h"

namespace irk {

/// Evaluates u, v, x, w at t + theta h from the stages W (n x s) of a solved step. C = W V^-T are the coefficients
/// of w = sum_k C_k P_k(theta) in the Legendre basis; v and x integrate this polynomial once, u twice. This is
/// stable for any s. The order is that of the polynomial (s), not that of the step's end. Owns scratch.
template <class Real>
class DenseOutput {
 public:
  explicit DenseOutput(const Sizes& sizes);

  /// Selects the step from `from` with the stages `past`. Keeps references: both must outlive the evaluations.
  void begin(const State<Real>& from, const StagePolynomial<Real>& past);
  /// Writes t, u, v, x, w at theta in [0, 1] to `out`; d is that of `from`.
  void evaluate(const Real& theta, State<Real>& out);
  /// The same at theta = j / kParts, 0 < j < kParts. The first call computes all these points of the step, in three
  /// products with the scheme's weights.
  void evaluateInside(Index j, State<Real>& out);

 private:
  template <class W, class Once, class Twice>
  void write(const Real& theta, const W& w, const Once& once, const Twice& twice, State<Real>& out) const;

  const State<Real>* from_ = nullptr;
  const StagePolynomial<Real>* past_ = nullptr;
  Index nu_, nx_;
  bool expanded_ = false, inside_ = false;  // whether C_, and w_, once_, twice_ are computed for past_
  Mat<Real> C_;                             // n x s, with s of the step
  Vec<Real> p_, integral_, second_;         // P_0 .. P_{s+1} at theta, their first and second integrals
  // w, the integral of (a, k), and the second integral of a: at theta, and at all inside points.
  Vec<Real> w_at_, once_at_, twice_at_;
  Mat<Real> w_, once_, twice_;  // n, nu + nx, nu rows
};

}  // namespace irk
