// Jacobi's elliptic functions in any precision. Internal.
#pragma once

namespace irk {

template <class Real>
struct JacobiFunctions {
  Real sn, cn, dn;
  Real am;  ///< the amplitude: sn = sin(am), cn = cos(am); it grows with u
};

/// sn, cn, dn and am of u for the parameter m = k^2 in [0, 1). Descending Landen transformation,
/// Abramowitz & Stegun 16.4. The absolute error is a few eps (1 + |u|).
template <class Real>
JacobiFunctions<Real> jacobiFunctions(const Real& u, const Real& m);

}  // namespace irk
