#include "tableaus/analysis/rooted_trees.h"

#include <algorithm>

#include "tableaus/files/file.h"
#include "tests/tableaus/support.h"

namespace irk {
namespace {

using tableaus::Verdict;

int countOfOrder(const std::vector<RootedTree>& trees, int order) {
  return static_cast<int>(std::ranges::count(trees, order, &RootedTree::order));
}

TreeConditions conditionsOf(const Tableau<BigFloat>& tableau) {
  return treeConditions(tableau, analyzeTableau(tableau));
}

// OEIS A000081.
TEST(RootedTrees, AreAsManyAsKnown) {
  const auto trees = rootedTrees(kMaxTreeOrder);
  const int known[] = {1, 1, 2, 4, 9, 20, 48, 115, 286, 719};
  for (int n = 1; n <= kMaxTreeOrder; ++n) EXPECT_EQ(countOfOrder(trees, n), known[n - 1]) << n;
  EXPECT_EQ(trees.size(), 1205u);
}

// With two kinds of leaves the trees of order 3 are [t t], [t u], [u u], [[t]], [[u]]; u alone is in the list but is
// no tree.
TEST(RootedTrees, TimeIsASecondKindOfLeaf) {
  const auto trees = rootedTrees(4, Leaves::kUnknownsAndTime);
  EXPECT_EQ(countOfOrder(trees, 1), 2);
  EXPECT_EQ(countOfOrder(trees, 2), 2);
  EXPECT_EQ(countOfOrder(trees, 3), 5);
  EXPECT_EQ(countOfOrder(trees, 4), 13);
}

TEST(RootedTrees, BushyAndTallOnesHaveDensitiesNAndNFactorial) {
  const auto trees = rootedTrees(kMaxTreeOrder);
  std::size_t tall = 0;  // place of the tall tree of order n - 1
  double factorial = 1;
  for (int n = 2; n <= kMaxTreeOrder; ++n) {
    factorial *= n;
    const auto find = [&](const std::vector<int>& children) {
      return std::ranges::find(trees, children, &RootedTree::children);
    };
    const auto bushy = find(std::vector<int>(static_cast<std::size_t>(n - 1), 0));
    ASSERT_NE(bushy, trees.end());
    EXPECT_EQ(bushy->order, n);
    EXPECT_EQ(bushy->density, n);
    const auto next = find({static_cast<int>(tall)});
    ASSERT_NE(next, trees.end());
    EXPECT_EQ(next->order, n);
    EXPECT_EQ(next->density, factorial);
    tall = static_cast<std::size_t>(next - trees.begin());
  }
}

// HW I, II.2: alpha(t) = n! / (gamma(t) sigma(t)) monotonic labellings, (n-1)! in all of order n. The symmetry sigma
// is counted here.
TEST(RootedTrees, MonotonicLabellingsAddUp) {
  const auto trees = rootedTrees(kMaxTreeOrder);
  std::vector<double> symmetry(trees.size(), 1), sums(kMaxTreeOrder, 0);
  for (std::size_t i = 0; i < trees.size(); ++i) {
    int repeated = 0;
    for (std::size_t k = 0; k < trees[i].children.size(); ++k) {
      const int child = trees[i].children[k];
      repeated = k > 0 && trees[i].children[k - 1] == child ? repeated + 1 : 1;
      symmetry[i] *= repeated * symmetry[static_cast<std::size_t>(child)];
    }
    sums[static_cast<std::size_t>(trees[i].order) - 1] += 1 / (trees[i].density * symmetry[i]);
  }
  for (std::size_t n = 1; n <= sums.size(); ++n) {
    EXPECT_NEAR(sums[n - 1], 1 / static_cast<double>(n), 1e-14) << n;
  }
}

TEST(TreeConditions, EveryFamilyHasExactlyItsOrder) {
  for (const Family& family : families()) {
    for (Index s = family.minStages(); s <= 4; ++s) {
      const auto conditions = conditionsOf(constructFamily(family, s));
      EXPECT_EQ(conditions.order, family.orders(s).p) << family.id << s;
      EXPECT_EQ(conditions.residuals.size(), conditions.order + 1);
    }
  }
}

TEST(TreeConditions, HoldUpToTheLargestTreesForManyStages) {
  for (const Family& family : families()) {
    const auto conditions = conditionsOf(constructFamily(family, 20));
    EXPECT_EQ(conditions.order, kMaxTreeOrder) << family.id;
    EXPECT_EQ(conditions.residuals.size(), kMaxTreeOrder);
  }
}

// b^T A c = 1/2 sum b c^2 is not 1/6: the quadrature has order 3, the method order 2.
TEST(TreeConditions, DetectErrorsThatQuadratureDoesNot) {
  Tableau<BigFloat> tableau{"", "user", Mat<BigFloat>::Zero(2, 2), Vec<BigFloat>(2), Vec<BigFloat>(2), 3, 1};
  tableau.b << BigFloat(1) / 4, BigFloat(3) / 4;
  tableau.c << 0, BigFloat(2) / 3;
  tableau.A(1, 0) = tableau.c[1];
  const auto conditions = conditionsOf(tableau);
  EXPECT_EQ(conditions.order, 2);
  EXPECT_NEAR(conditions.residuals[2], 1.0 / 6, 1e-15);
}

// Alexander, SIAM J. Numer. Anal. 14 (1977).
const std::string kSdirk3 = R"(stages: 3
order: 3
stage_order: 1
digits: 30
A
0.435866521508458999416019451194 0 0
0.282066739245770500291990274403 0.435866521508458999416019451194 0
1.208496649176010070336477684063 -0.644363170684469069752497135257 0.435866521508458999416019451194
b
1.208496649176010070336477684063 -0.644363170684469069752497135257 0.435866521508458999416019451194
c
0.435866521508458999416019451194 0.717933260754229499708009725597 1
)";

// HNW I, II.7, Table 7.2: gamma = (3 + sqrt 3) / 6.
const std::string kCrouzeix = R"(stages: 2
order: 3
stage_order: 1
digits: 30
A
0.788675134594812882254574390251 0
-0.577350269189625764509148780502 0.788675134594812882254574390251
b
1/2 1/2
c
0.788675134594812882254574390251 0.211324865405187117745425609749
)";

TEST(TreeConditions, UsersMethodsAreJudgedCorrectly) {
  for (const std::string& text : {kSdirk3, kCrouzeix}) {
    const auto report = checkTableau(parseTableau(text, "mine"));
    EXPECT_TRUE(report.ok) << report.text;
    EXPECT_EQ(report.analysis.q, 1);
    EXPECT_TRUE(contains(report.text, "of all rooted trees the order is 3;"));
  }
}

TEST(TreeConditions, FalseOrdersAreContradictedAndLowOnesNoted) {
  std::string understated = kCrouzeix;
  understated.replace(understated.find("order: 3"), 8, "order: 2");
  auto report = checkTableau(parseTableau(understated, "mine"));
  EXPECT_TRUE(report.ok);
  EXPECT_EQ(report.findings.back().verdict, Verdict::kNote);

  // Nodes and weights are those of Gauss: B, C, D alone cannot disprove order 4, they only leave it unproven.
  auto overstated = parseTableau(kCrouzeix, "mine");
  overstated.tableau.order = 4;
  report = checkTableau(overstated);
  EXPECT_EQ(report.analysis.p, 4);
  EXPECT_FALSE(report.ok);
  EXPECT_EQ(report.findings.back().verdict, Verdict::kContradiction);
  EXPECT_TRUE(contains(report.text, "contradicted by a rooted tree of order 4: the order is 3"));
}

}  // namespace
}  // namespace irk
