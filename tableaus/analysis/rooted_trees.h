// Order conditions by rooted trees. They give the true order, while B, C, D only prove a lower bound. HW I, II.2.
#pragma once

#include <vector>

#include "tableaus/analysis/analysis.h"
#include "tableaus/families/precise.h"

namespace irk {

/// There are 1205 trees up to this order; the next order alone has 1842.
inline constexpr int kMaxTreeOrder = 10;

/// The tree [t_1, ..., t_m]: a root with subtrees that stand earlier in the list.
struct RootedTree {
  int order;                  ///< number of vertices
  double density;             ///< gamma(t), at most order!; exact in double
  std::vector<int> children;  ///< indices in the list, descending
};

/// The kinds of leaves. For y' = f(t, y) time is one more unknown, whose stage values are c. It differs from the
/// other unknowns, whose leaves have the values A 1, only if row sums of A differ from c.
enum class Leaves { kUnknowns, kUnknownsAndTime };

/// All trees up to an order, by ascending order: 1, 1, 2, 4, 9, 20, 48, 115, 286, 719 of them. The leaf of time, if
/// any, is the second entry of the list; it does not count as a tree.
std::vector<RootedTree> rootedTrees(int max_order, Leaves leaves = Leaves::kUnknowns);

struct TreeConditions {
  int order;  ///< largest p <= kMaxTreeOrder with all conditions up to p; 0 if not even sum b = 1
  /// Entry p-1: the largest |sum_i b_i Phi_i(t) - 1/gamma(t)| over the trees of order p, each divided by the sum of
  /// its terms' magnitudes if that exceeds 1. The entries end with the first order at which B(p), the bushy tree's
  /// condition, fails, because the order is then known.
  Vec<double> residuals;
};

/// `analysis` belongs to this tableau; its tolerance is used here, too.
TreeConditions treeConditions(const Tableau<BigFloat>& tableau, const TableauAnalysis& analysis);

}  // namespace irk
