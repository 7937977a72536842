// Theoretical orders of convergence per family, kind of system and component.
#pragma once

#include <optional>
#include <string_view>

#include "irk/scalar.h"

namespace irk {

enum class SystemKind {
  kOde,               ///< x; u and v of unconstrained systems
  kIndex1,            ///< x' = f(x, z), 0 = g(x, z)
  kIndex2,            ///< x' = f(x, z), 0 = g(x)
  kIndex3,            ///< y' = f(y, w), w' = k(y, w, z), 0 = g(y); x is (y, w)
  kMechanical3,       ///< M q'' = f - G^T lambda, 0 = g(q): u, v, z = q, q', lambda
  kMechanical2,       ///< the same with 0 = dg/dt
  kProjected,         ///< index 2, one projection of v per step
  kGgl,               ///< Gear, Gupta & Leimkuhler
  kStiffFixedZ,       ///< Prothero & Robinson, power of h at h lambda = z -> -infinity
  kStiffPowerOfZ,     ///< the same, power of |z|
  kStiffFixedLambda,  ///< the same, power of h at fixed lambda, |h lambda| >> 1
};

struct TheoreticalOrder {
  double order;
  /// `theorem` (HW, HLR, Jay below), `measured` (s <= 5, independent slopes in 60 to 100 digits) or `extrapolated`
  /// (the measured pattern, for more stages).
  std::string_view source;
};

/// Exponent of the global error of component 'u', 'v', 'x' or 'z' at a fixed time with constant steps; z is advanced
/// by z1 = (1 - b^T A^-1 1) z0 + b^T A^-1 Z. nullopt if no order is known, or if the family cannot treat algebraic
/// unknowns. HW: Hairer & Wanner II (1996), IV.5, IV.15, VI.1, VII.4. HLR: Hairer, Lubich & Roche, LNM 1409 (1989),
/// table 4.1 and section 6. Jay, BIT 33 (1993): Lobatto IIIA of index 2, Radau IIA and Lobatto IIIC of index 3.
std::optional<TheoreticalOrder> theoreticalOrder(std::string_view family, Index s, SystemKind kind, char component);

/// Whether the methods of a family are their own adjoints: for differential equations their global error then has
/// only even powers of the step. Hairer, Norsett & Wanner I, II.8 and II.9.
bool isSymmetric(std::string_view family);

}  // namespace irk
