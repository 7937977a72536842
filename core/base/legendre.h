// Legendre polynomials on [0, 1]. They are the basis of the polynomial through the stages.
#pragma once

#include "irk/scalar.h"

namespace irk {

/// Writes P_0, P_1, ... at x to p, as many as p has entries; orthonormal on [0, 1], by the three-term recurrence.
/// x may lie outside of [0, 1].
template <class Real>
void legendre(const Real& x, Eigen::Ref<Vec<Real>> p);

/// Integrates from 0 to x once and twice. p: the values of P_0 .. P_{s+1} at x; once: the integrals of P_0 .. P_s;
/// twice: the second integrals of P_0 .. P_{s-1}. `once` and `twice` have the right size already.
///   int_0^x P_k = xi_{k+1} P_{k+1} - xi_k P_{k-1},  xi_k = 1 / (2 sqrt(4 k^2 - 1)),  HW II (IV.5).
template <class Real>
void integrateLegendre(const Vec<Real>& p, Vec<Real>& once, Vec<Real>& twice);

}  // namespace irk
