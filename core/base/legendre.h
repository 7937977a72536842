// Legendre polynomials on [0, 1], the basis of the stages' polynomial.
#pragma once

#include "irk/scalar.h"

namespace irk {

/// P_0, P_1, ... at x, orthonormal on [0, 1], by the three-term recurrence. Of any size; x may lie outside.
template <class Real>
void legendre(const Real& x, Eigen::Ref<Vec<Real>> p);

/// From P_0 .. P_{s+1} at x the integrals from 0 to x of P_0 .. P_s, and of those of P_0 .. P_{s-1}:
///   int_0^x P_k = xi_{k+1} P_{k+1} - xi_k P_{k-1},  xi_k = 1 / (2 sqrt(4 k^2 - 1)),  HW II (IV.5).
template <class Real>
void integrateLegendre(const Vec<Real>& p, Vec<Real>& once, Vec<Real>& twice);

}  // namespace irk
