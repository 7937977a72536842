// The eight families: their theoretical orders, and one construction for all of them.
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

/// The quadrature of a family. The kinds differ in which of the ends 0 and 1 are nodes.
enum class Quadrature { kGauss, kRadauLeft, kRadauRight, kLobatto };

/// A family as data: its quadrature, and the last row and column of its matrix X.
struct Family {
  std::string id, title;
  Quadrature quadrature;
  int p_gap, q_gap, r_gap;  ///< p = 2s - p_gap, q = s - q_gap, r = s - r_gap
  int above, below;         ///< 1 keeps X_{s-1,s} or X_{s,s-1}, 0 sets it to zero
  int corner;               ///< -1, 0, 1: sign of the term added to X_ss

  Index minStages() const { return quadrature == Quadrature::kLobatto ? 2 : 1; }
  SimplifyingOrders orders(Index s) const;
};

/// All families, in the order of tableaus/README.md.
const std::vector<Family>& families();

/// Returns nullptr if no family has this id.
const Family* findFamily(std::string_view id);

/// Throws Misuse for an unknown id, naming the nearest family.
const Family& familyOf(std::string_view id);

/// Throws Misuse, naming the range, unless minStages() <= s <= kMaxStages.
void requireStages(const Family& family, Index s);

/// The s-stage member. Throws Misuse as requireStages. HW II, IV.5 in the orthonormal Legendre basis W:
/// A = W X D^-1 W^T diag(b). The coefficients have kSpareDigits more than the working digits, of which at most the last
/// 20 are wrong; coefficients that are zero are exactly zero.
Tableau<BigFloat> constructFamily(const Family& family, Index s);

}  // namespace irk
