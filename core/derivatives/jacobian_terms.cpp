// The simplifications of the Jacobian that come with the library.
#include "core/derivatives/differentiator.h"
#include "irk/multiprecision.h"

namespace irk {
namespace {

template <class Real>
void dropConstraintXz(const Sizes& n, Linearization<Real>& out) {
  const Index first = n.nu + n.nx;
  out.pattern->forEachInBlock(first, n.nz, first, n.nz, [&](Index k) { out.d0[k] = Real(0); });
  out.pattern->forEachInBlock(first, n.nz, n.nu, n.nx, [&](Index k) { out.d1[k] = Real(0); });
}

}  // namespace

template <>
Catalogue<JacobianTerms>& catalogue<JacobianTerms>() {
  static Catalogue<JacobianTerms> all({
      {.id = JacobianTerms::kFull, .meaning = "everything"},
      {.id = JacobianTerms::kNoMassVxz, .meaning = "(4.4): without d(M a)/d(v, x, z)", .mass_without_vxz = true},
      {.id = JacobianTerms::kNoConstraintXz,
       .meaning = "(4.5): without dG/d(x, z)",
       .change = {dropConstraintXz<double>, dropConstraintXz<BigFloat>}},
      {.id = JacobianTerms::kNoMass,
       .meaning = "(4.4) and (4.8): without d(M a)/d(u, v, x, z)",
       .mass_without_vxz = true,
       .mass_without_u = true},
      {.id = JacobianTerms::kConstantStiffness, .meaning = "(4.7): dF2/du evaluated once", .stiffness_once = true},
  });
  return all;
}

IRK_STRATEGIES(JacobianTerms, "jacobian")

}  // namespace irk
