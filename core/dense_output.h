// The solution inside a step: the stages' polynomial, integrated in the Legendre basis.
#pragma once

#include "core/predictor.h"

namespace irk {

/// u, v, x, w at t + theta h from the stages of a solved step. W V^-T are the coefficients of
/// w = sum_k C_k P_k(theta); v and x integrate them once, u twice:
///   int_0^theta P_k = xi_{k+1} P_{k+1} - xi_k P_{k-1},  xi_k = 1 / (2 sqrt(4 k^2 - 1)),  HW II (IV.5).
/// Stable for any s. Order: that of the polynomial (s), not that of the step's end. Owns scratch.
template <class Real>
class DenseOutput {
 public:
  explicit DenseOutput(const Sizes& sizes) : nu_(sizes.nu), nx_(sizes.nx) {}

  /// For the step from `from` with the stages `past`; both must outlive the evaluations.
  void begin(const State<Real>& from, const StagePolynomial<Real>& past);
  /// theta in [0, 1]; writes t, u, v, x, w; d is that of `from`.
  void evaluate(const Real& theta, State<Real>& out);

 private:
  const State<Real>* from_ = nullptr;
  Real h_{};
  Index nu_, nx_;
  Mat<Real> C_;            // n x s, s that of the step
  Vec<Real> xi_;           // xi_0 (not used) .. xi_{s+1}
  Vec<Real> p_;            // P_0 .. P_{s+1} at theta
  Vec<Real> once_, twice_;  // integrals of P_0 .. P_s from 0 to theta
};

}  // namespace irk
