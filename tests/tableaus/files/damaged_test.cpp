// Five damaged versions of the 3-stage Radau IIA tableau that most integration tests do not detect.
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "irk/multiprecision.h"
#include "tableaus/analysis/check.h"
#include "tableaus/analysis/rooted_trees.h"
#include "tests/tableaus/support.h"

namespace irk {
namespace {

using tableaus::Finding;
using tableaus::Verdict;

constexpr double kDamage = 1e-3;

template <class Real>
void moveNode(Tableau<Real>& tableau) {
  tableau.c[0] += Real(kDamage);
}

template <class Real>
void swapNodes(Tableau<Real>& tableau) {
  std::swap(tableau.c[0], tableau.c[1]);
}

template <class Real>
void transpose(Tableau<Real>& tableau) {
  tableau.A.transposeInPlace();
}

template <class Real>
void shiftWithinRow(Tableau<Real>& tableau) {
  tableau.A(0, 0) += Real(kDamage);
  tableau.A(0, 1) -= Real(kDamage);
}

/// P = I + w v^T with v orthogonal to 1 and c, w orthogonal to b: then P 1 = 1, P c = c, b^T P = b^T, so row sums, B
/// and R(z) do not change.
template <class Real>
void transformSimilarly(Tableau<Real>& tableau) {
  const Eigen::Matrix<Real, 3, 1> ones(1, 1, 1), b = tableau.b, c = tableau.c;
  const Eigen::Matrix<Real, 3, 1> v = ones.cross(c), w = b.cross(ones);
  const Mat<Real> P = Mat<Real>::Identity(3, 3) + w * v.transpose();
  tableau.A = (P.inverse() * tableau.A * P).eval();
}

template <class Real>
struct Damage {
  std::string name;
  void (*apply)(Tableau<Real>&);
};

template <class Real>
class Damaged : public testing::Test {
 protected:
  const std::vector<Damage<Real>> damages = {{"node moved", moveNode<Real>},
                                             {"nodes swapped", swapNodes<Real>},
                                             {"A transposed", transpose<Real>},
                                             {"row shifted", shiftWithinRow<Real>},
                                             {"similar A", transformSimilarly<Real>}};
};

using Scalars = testing::Types<double, BigFloat>;
TYPED_TEST_SUITE(Damaged, Scalars);

TYPED_TEST(Damaged, UndamagedPasses) {
  const auto report = checkTableau(makeTableau<TypeParam>("radau_iia_3"));
  EXPECT_TRUE(report.ok) << report.text;
}

TYPED_TEST(Damaged, EachIsCaughtByItsFamily) {
  for (const auto& damage : this->damages) {
    auto tableau = makeTableau<TypeParam>("radau_iia_3");
    damage.apply(tableau);
    EXPECT_FALSE(checkTableau(tableau).ok) << damage.name;
  }
}

// No family is given for comparison: B, C, D are checked against the declared orders alone.
TYPED_TEST(Damaged, EachIsCaughtByBCD) {
  for (const auto& damage : this->damages) {
    auto tableau = makeTableau<TypeParam>("radau_iia_3");
    tableau.family = "user";
    EXPECT_TRUE(checkTableau(tableau).ok);
    damage.apply(tableau);
    EXPECT_FALSE(checkTableau(tableau).ok) << damage.name;
  }
}

TYPED_TEST(Damaged, EachLowersTheOrderByTrees) {
  const auto orderOf = [](const Tableau<TypeParam>& tableau) {
    return treeConditions(tableau.template cast<BigFloat>(), analyzeTableau(tableau)).order;
  };
  EXPECT_EQ(orderOf(makeTableau<TypeParam>("radau_iia_3")), 5);
  for (const auto& damage : this->damages) {
    auto tableau = makeTableau<TypeParam>("radau_iia_3");
    damage.apply(tableau);
    EXPECT_LT(orderOf(tableau), 5) << damage.name;
  }
}

TYPED_TEST(Damaged, SimilarTableauKeepsQuadratureRowSumsAndStability) {
  auto tableau = makeTableau<TypeParam>("radau_iia_3");
  const auto original = tableau;
  transformSimilarly(tableau);
  EXPECT_GT(largestDifference<TypeParam>(tableau.A, original.A), kDamage);
  const auto analysis = analyzeTableau(tableau);
  EXPECT_EQ(analysis.p, 5);
  EXPECT_EQ(analysis.q, 1);
  // b^T A^k 1, k = 0 .. 5, determine R(z), a ratio of cubics.
  Vec<TypeParam> x = Vec<TypeParam>::Ones(3), y = x;
  for (int k = 0; k <= 5; ++k) {
    EXPECT_LE(abs(tableau.b.dot(x) - original.b.dot(y)), analysis.tolerance) << k;
    x = tableau.A * x;
    y = original.A * y;
  }
}

TYPED_TEST(Damaged, DamageJustAboveTheToleranceIsCaught) {
  auto tableau = makeTableau<TypeParam>("radau_iia_3");
  tableau.c[0] += TypeParam(10 * roundingTolerance<TypeParam>());
  EXPECT_FALSE(checkTableau(tableau).ok);
}

Verdict verdictOn(const TableauReport& report, const std::string& name) {
  for (const Finding& finding : report.findings) {
    if (finding.name == name) return finding.verdict;
  }
  ADD_FAILURE() << "no finding '" << name << "'";
  return Verdict::kNote;
}

TEST(Check, OrderBeyondBCDIsUnprovenNotWrong) {
  Tableau<double> kutta{
      "kutta", "user", Mat<double>::Zero(4, 4), Vec<double>{{1, 2, 2, 1}} / 6.0, Vec<double>{{0, 0.5, 0.5, 1}}, 4, 1};
  kutta.A(1, 0) = kutta.A(2, 1) = 0.5;
  kutta.A(3, 2) = 1;
  auto report = checkTableau(kutta);
  EXPECT_TRUE(report.ok) << report.text;
  EXPECT_EQ(verdictOn(report, "order"), Verdict::kUnproven);
  EXPECT_TRUE(contains(report.text, "B, C, D prove order 3 only"));

  kutta.order = 5;
  report = checkTableau(kutta);
  EXPECT_FALSE(report.ok);
  EXPECT_EQ(verdictOn(report, "B"), Verdict::kContradiction);
}

TEST(Check, ImpossibleOrdersAreRefused) {
  auto tableau = makeTableau<double>("gauss_30");
  tableau.family = "user";
  for (const int order : {-1, 0, 61}) {
    tableau.order = order;
    EXPECT_EQ(verdictOn(checkTableau(tableau), "B"), Verdict::kContradiction) << order;
  }
  for (const int stage_order : {-1, 31, 1000}) {
    tableau.stage_order = stage_order;
    EXPECT_EQ(verdictOn(checkTableau(tableau), "C"), Verdict::kContradiction) << stage_order;
  }
}

TEST(Check, UnderstatedOrderIsNoted) {
  auto tableau = makeTableau<double>("gauss_2");
  tableau.family = "user";
  tableau.order = 3;
  const auto report = checkTableau(tableau);
  EXPECT_TRUE(report.ok);
  EXPECT_EQ(verdictOn(report, "order"), Verdict::kNote);
}

// The three families have the same B, C, D: only the coefficients distinguish them.
TEST(Check, LobattoFamiliesAreNotMistakenForEachOther) {
  for (const auto given : {"lobatto_iiic", "lobatto_iiics", "lobatto_iiid"}) {
    for (const auto claimed : {"lobatto_iiic", "lobatto_iiics", "lobatto_iiid"}) {
      auto tableau = makeTableau<double>(memberId(given, 4));
      tableau.family = claimed;
      EXPECT_EQ(checkTableau(tableau).ok, std::string(given) == claimed) << given << claimed;
    }
  }
}

TEST(Check, EveryFamilyPasses) {
  for (const FamilyEntry& family : familyCatalogue()) {
    for (Index s = family.min_stages; s <= 12; ++s) {
      const auto report = checkTableau(makeTableau<double>(memberId(family.id, s)));
      EXPECT_TRUE(report.ok) << report.text;
      EXPECT_EQ(verdictOn(report, "order"), Verdict::kHolds) << report.text;
    }
  }
}

}  // namespace
}  // namespace irk
