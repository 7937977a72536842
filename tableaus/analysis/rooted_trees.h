// Order conditions by rooted trees: the order that a tableau has, not only what B, C, D prove.
// Hairer, Norsett & Wanner I, II.2.
#pragma once

#include <vector>

#include "tableaus/analysis/analysis.h"
#include "tableaus/families/precise.h"

namespace irk {

/// 1205 trees; the next order alone has 1842.
inline constexpr int kMaxTreeOrder = 10;

/// t = [t_1, ..., t_m]: the root, and on it trees that come earlier in the list.
struct RootedTree {
  int order;                  ///< number of vertices
  double density;             ///< gamma(t), at most order!: exact
  std::vector<int> children;  ///< places in the list, descending
};

/// The kinds of leaves that trees are made of. For y' = f(t, y) time is one more unknown, whose
/// stage values are c; it is told apart from the others' (A 1) only where row sums of A are not c.
enum class Leaves { kUnknowns, kUnknownsAndTime };

/// All trees up to an order, by ascending order: 1, 1, 2, 4, 9, 20, 48, 115, 286, 719 of them.
/// Time's leaf, if any, follows the first tree, and is no tree itself.
std::vector<RootedTree> rootedTrees(int max_order, Leaves leaves = Leaves::kUnknowns);

struct TreeConditions {
  int order;  ///< largest p <= kMaxTreeOrder with all conditions up to p; 0 if not even sum b = 1
  /// Entry p-1: the worst |sum_i b_i Phi_i(t) - 1/gamma(t)| of the trees of order p, divided by the
  /// sum of its terms' magnitudes if that exceeds 1. Up to the first order at which B(p), the bushy
  /// tree's condition, fails: there the order is known.
  Vec<double> residuals;
};

/// `analysis` is the tableau's; its tolerance holds here, too.
TreeConditions treeConditions(const Tableau<mp80>& tableau, const TableauAnalysis& analysis);

}  // namespace irk
