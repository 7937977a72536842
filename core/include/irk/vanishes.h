// Whether numbers and their derivatives are exactly zero: a residual may then leave out terms that are multiplied by
// them.
//
// The simplified Jacobians `no_mass` and `no_mass_vxz` differentiate at a = 0 (JacobianTerms, irk/options.h). A problem
// whose M(u) is expensive can skip it there:
//
//   template <class T>
//   void residual(const Point<T>& p, Rows<T> r) const {
//     ... // the forces
//     if (vanishes(p.a)) return;
//     ... // r.u -= M a
//   }
#pragma once

#include "irk/dual.h"
#include "irk/scalar.h"

namespace irk {

template <class T>
bool vanishes(const T& x) {
  return x == T(0.0);
}
template <class T, std::size_t N>
bool vanishes(const DualNumber<T, N>& x) {
  if (!vanishes(x.value)) return false;
  for (const T& rate : x.d) {
    if (!vanishes(rate)) return false;
  }
  return true;
}
/// Whether all numbers of a vector vanish; true for an empty one.
template <class T>
bool vanishes(const ConstVec<T>& x) {
  for (Index i = 0; i < x.size(); ++i) {
    if (!vanishes(x[i])) return false;
  }
  return true;
}

}  // namespace irk
