#include "tableaus/analysis/rooted_trees.h"
#include "tableaus/families/precise.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace irk {
namespace {

constexpr int kTimeLeaf = 1;  // index in the list

/// Appends all trees of one order: every multiset of smaller trees once, in descending order.
class Grafting {
 public:
  Grafting(std::vector<RootedTree>& trees, int order)
      : trees_(trees), order_(order), smaller_(static_cast<int>(trees.size())) {}

  void run() { graft(order_ - 1, smaller_ - 1, order_); }

 private:
  // `density` is gamma(t) = order(t) gamma(t_1) ... gamma(t_m) of the trees grafted so far, HW I, Definition II.2.10.
  void graft(int vertices, int largest, double density) {
    if (vertices == 0) {
      trees_.push_back({order_, density, children_});
      return;
    }
    for (int child = largest; child >= 0; --child) {
      const auto [order, child_density] = sizeOf(child);
      if (order > vertices) continue;
      children_.push_back(child);
      graft(vertices - order, child, density * child_density);
      children_.pop_back();
    }
  }

  std::pair<int, double> sizeOf(int child) const {
    const RootedTree& tree = trees_[static_cast<std::size_t>(child)];
    return {tree.order, tree.density};
  }

  std::vector<RootedTree>& trees_;
  int order_, smaller_;
  std::vector<int> children_;
};

/// Stores for each tree the factor (A Phi(t))_i that a parent multiplies by, and the same for magnitudes: each
/// subtree costs one matrix-vector product, however often it occurs.
class Weights {
 public:
  explicit Weights(const Tableau<BigFloat>& tableau)
      : tableau_(tableau), A_abs_(tableau.A.cwiseAbs().cast<double>()), b_abs_(tableau.b.cwiseAbs().cast<double>()) {}

  void appendTime() {
    grafted_.push_back(tableau_.c);
    grafted_abs_.push_back(tableau_.c.cwiseAbs().cast<double>());
  }

  /// Returns the residual of the tree's condition. `is_child` tells whether later trees contain it.
  double append(const RootedTree& tree, bool is_child) {
    const Index s = tableau_.stages();
    Vec<BigFloat> phi = Vec<BigFloat>::Ones(s);
    Vec<double> phi_abs = Vec<double>::Ones(s);
    for (const int child : tree.children) {
      phi.array() *= grafted_[static_cast<std::size_t>(child)].array();
      phi_abs.array() *= grafted_abs_[static_cast<std::size_t>(child)].array();
    }
    if (is_child) {
      grafted_.push_back(tableau_.A * phi);
      grafted_abs_.push_back(A_abs_ * phi_abs);
    }
    const BigFloat error = tableau_.b.dot(phi) - 1 / BigFloat(tree.density);
    return std::abs(static_cast<double>(error)) / std::max(1.0, b_abs_.dot(phi_abs));
  }

 private:
  const Tableau<BigFloat>& tableau_;
  Mat<double> A_abs_;
  Vec<double> b_abs_;
  std::vector<Vec<BigFloat>> grafted_;
  std::vector<Vec<double>> grafted_abs_;
};

}  // namespace

std::vector<RootedTree> rootedTrees(int max_order, Leaves leaves) {
  std::vector<RootedTree> trees;
  if (max_order < 1) return trees;
  trees.push_back({1, 1, {}});
  if (leaves == Leaves::kUnknownsAndTime) trees.push_back({1, 1, {}});
  for (int order = 2; order <= max_order; ++order) Grafting(trees, order).run();
  return trees;
}

TreeConditions treeConditions(const Tableau<BigFloat>& tableau, const TableauAnalysis& analysis) {
  const WorkingDigits digits(kAnalysisDigits);
  const int max_order = std::min(kMaxTreeOrder, analysis.p + 1);
  const bool time = analysis.q < 1;
  const auto trees = rootedTrees(max_order, time ? Leaves::kUnknownsAndTime : Leaves::kUnknowns);

  TreeConditions conditions{0, Vec<double>::Zero(max_order)};
  Weights weights(tableau);
  for (std::size_t i = 0; i < trees.size(); ++i) {
    if (time && i == kTimeLeaf) {
      weights.appendTime();
      continue;
    }
    double& worst = conditions.residuals[trees[i].order - 1];
    const double residual = weights.append(trees[i], trees[i].order < max_order);
    if (!(residual <= worst)) worst = residual;  // also if it is NaN
  }
  while (conditions.order < max_order && conditions.residuals[conditions.order] <= analysis.tolerance) {
    ++conditions.order;
  }
  return conditions;
}

}  // namespace irk
