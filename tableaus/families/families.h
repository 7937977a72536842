// The eight families: what theory says of each, and one construction for all of them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "irk/tableau.h"
#include "tableaus/families/precise.h"

namespace irk {

/// B(p), C(q) and D(r): Butcher's simplifying assumptions.
struct SimplifyingOrders {
  int p, q, r;
};

/// Quadrature that a family stands on; the ends 0 and 1 that are nodes distinguish them.
enum class Quadrature { kGauss, kRadauLeft, kRadauRight, kLobatto };

/// A family as data: its quadrature and the last row and column of its matrix X.
struct Family {
  std::string id, title;
  Quadrature quadrature;
  int p_gap, q_gap, r_gap;  ///< p = 2s - p_gap, q = s - q_gap, r = s - r_gap
  int above, below;         ///< 1 or 0: X_{s-1,s} and X_{s,s-1} are kept or zero
  int corner;               ///< -1, 0, 1: sign of what is added at X_ss

  Index minStages() const { return quadrature == Quadrature::kLobatto ? 2 : 1; }
  SimplifyingOrders orders(Index s) const;
};

/// All families in theory's order.
const std::vector<Family>& families();

/// Null if no family has this id.
const Family* findFamily(std::string_view id);

/// Throws Misuse that names the nearest family.
const Family& familyOf(std::string_view id);

/// The s-stage member; throws Misuse, naming the range, unless minStages() <= s <= kMaxStages.
/// Hairer & Wanner II, IV.5 in the orthonormal Legendre basis W: A = W X D^-1 W^T diag(b).
/// All but 20 digits of Real (mp80, mp130) are right at least; coefficients that are zero are exactly
/// zero.
template <class Real = mp80>
Tableau<Real> constructFamily(const Family& family, Index s);

}  // namespace irk
