#include "tableaus/families/families.h"

#include <algorithm>
#include <cstdlib>

#include "tableaus/analysis/analysis.h"
#include "tests/tableaus/support.h"

namespace irk {
namespace {

// The construction's round-off is 1e-79. The smallest residual of a condition that must be violated is that of
// B(2s+1) for Gauss: about 16^-s, 1e-48 at s = 40.
constexpr double kConstructionTolerance = 1e-70;

double largest(const Vec<double>& residuals, int conditions) {
  return conditions == 0 ? 0 : residuals.head(conditions).maxCoeff();
}

double largestResidual(const TableauAnalysis& analysis, const SimplifyingOrders& orders) {
  return std::max({largest(analysis.residuals.B, orders.p), largest(analysis.residuals.C, orders.q),
                   largest(analysis.residuals.D, orders.r)});
}

TEST(Families, FulfilBCDOfTheoryAndNoMore) {
  for (const Family& family : families()) {
    for (Index s = family.minStages(); s <= 40; s += s < 10 ? 1 : 6) {
      SCOPED_TRACE(memberId(family.id, s));
      const SimplifyingOrders orders = family.orders(s);
      const auto analysis = analyzeTableau(constructFamily(family, s), kConstructionTolerance);
      EXPECT_EQ(analysis.p, orders.p);
      EXPECT_EQ(analysis.q, orders.q);
      EXPECT_EQ(analysis.r, orders.r);
      EXPECT_EQ(analysis.proven_order, orders.p);
    }
  }
}

// The table of families in tableaus/README.md, written out once more: B, C, D of the five-stage members.
TEST(Families, OrdersOfFiveStages) {
  const int expected[][3] = {{10, 5, 5}, {9, 4, 5}, {9, 5, 4}, {8, 5, 3}, {8, 3, 5}, {8, 4, 4}, {8, 4, 4}, {8, 4, 4}};
  ASSERT_EQ(families().size(), std::size(expected));
  for (std::size_t i = 0; i < families().size(); ++i) {
    SCOPED_TRACE(families()[i].id);
    const SimplifyingOrders orders = families()[i].orders(5);
    EXPECT_EQ(orders.p, expected[i][0]);
    EXPECT_EQ(orders.q, expected[i][1]);
    EXPECT_EQ(orders.r, expected[i][2]);
  }
}

// A rounding error of half an ulp per coefficient changes a condition by at most about an eps.
TEST(Families, RoundedToDoubleKeepResidualsBelow6e16) {
  for (const Family& family : families()) {
    for (Index s = family.minStages(); s <= 40; s += s < 10 ? 1 : 6) {
      const auto analysis = analyzeTableau(makeTableau<double>(memberId(family.id, s)));
      EXPECT_LT(largestResidual(analysis, family.orders(s)), 6e-16) << memberId(family.id, s);
    }
  }
}

TEST(Families, RoundedToDoubleKeepResidualsBelow6e16With100Stages) {
  for (const auto id : {"gauss", "radau_iia", "lobatto_iiic"}) {
    const auto analysis = analyzeTableau(makeTableau<double>(memberId(id, kMaxStages)));
    EXPECT_LT(largestResidual(analysis, familyOf(id).orders(kMaxStages)), 6e-16) << id;
  }
}

TEST(Families, Mp50CarriesFiftyDigits) {
  for (const Family& family : families()) {
    const auto analysis = analyzeTableau(makeTableau<BigFloat>(memberId(family.id, 12)));
    EXPECT_LT(largestResidual(analysis, family.orders(12)), 1e-49) << family.id;
  }
}

TEST(Families, DoublesAreTheDecimalsRoundedOnce) {
  for (const Family& family : families()) {
    const auto exact = constructFamily(family, 17);
    const auto rounded = makeTableau<double>(memberId(family.id, 17));
    for (Index i = 0; i < exact.A.size(); ++i) {
      EXPECT_EQ(rounded.A.reshaped()[i], std::strtod(exact.A.reshaped()[i].str(70).c_str(), nullptr));
    }
  }
}

TEST(Families, NodesAscendAndEndsAreExact) {
  for (const Family& family : families()) {
    for (Index s : {2, 3, 7, 30}) {
      const auto tableau = makeTableau<double>(memberId(family.id, s));
      EXPECT_TRUE(std::is_sorted(tableau.c.begin(), tableau.c.end())) << tableau.id;
      EXPECT_GE(tableau.c[0], 0) << tableau.id;
      EXPECT_LE(tableau.c[s - 1], 1) << tableau.id;
      const bool left = family.id == "radau_ia" || family.id.starts_with("lobatto");
      const bool right = family.id == "radau_iia" || family.id.starts_with("lobatto");
      EXPECT_EQ(tableau.c[0] == 0, left) << tableau.id;
      EXPECT_EQ(tableau.c[s - 1] == 1, right) << tableau.id;
    }
  }
}

TEST(Families, StructuralZerosAreExact) {
  for (Index s : {2, 5, 40}) {
    EXPECT_TRUE(makeTableau<double>(memberId("lobatto_iiia", s)).A.row(0).isZero(0));
    EXPECT_TRUE(makeTableau<double>(memberId("lobatto_iiib", s)).A.col(s - 1).isZero(0));
    EXPECT_TRUE(makeTableau<double>(memberId("lobatto_iiics", s)).A.row(0).isZero(0));
    EXPECT_TRUE(makeTableau<double>(memberId("lobatto_iiics", s)).A.col(s - 1).isZero(0));
  }
}

struct KnownTableau {
  std::string id;
  Mat<BigFloat> A;
  Vec<BigFloat> b, c;
};

void expectKnown(const KnownTableau& known) {
  SCOPED_TRACE(known.id);
  const auto tableau = makeTableau<BigFloat>(known.id);
  const double tolerance = 1e-49;  // a few roundings of numbers below 1
  EXPECT_LT(largestDifference<BigFloat>(tableau.A, known.A), tolerance);
  EXPECT_LT(largestDifference<BigFloat>(tableau.b, known.b), tolerance);
  EXPECT_LT(largestDifference<BigFloat>(tableau.c, known.c), tolerance);
}

template <class Block>
Block filled(Index rows, Index columns, std::initializer_list<BigFloat> values) {
  Block block(rows, columns);
  std::copy(values.begin(), values.end(), block.template reshaped<Eigen::RowMajor>().begin());
  return block;
}

Mat<BigFloat> square(Index s, std::initializer_list<BigFloat> values) { return filled<Mat<BigFloat>>(s, s, values); }

Vec<BigFloat> column(std::initializer_list<BigFloat> values) {
  return filled<Vec<BigFloat>>(static_cast<Index>(values.size()), 1, values);
}

// HW II, tables IV.5.2, IV.5.4, IV.5.6.
TEST(Families, EqualTheSurdsOfTheBooks) {
  const BigFloat r3 = sqrt(BigFloat(3)), r6 = sqrt(BigFloat(6)), one = 1;
  expectKnown({"gauss_2", square(2, {one / 4, one / 4 - r3 / 6, one / 4 + r3 / 6, one / 4}), column({one / 2, one / 2}),
               column({one / 2 - r3 / 6, one / 2 + r3 / 6})});
  expectKnown({"radau_ia_3",
               square(3, {one / 9, (-1 - r6) / 18, (-1 + r6) / 18,             //
                          one / 9, (88 + 7 * r6) / 360, (88 - 43 * r6) / 360,  //
                          one / 9, (88 + 43 * r6) / 360, (88 - 7 * r6) / 360}),
               column({one / 9, (16 + r6) / 36, (16 - r6) / 36}), column({0, (6 - r6) / 10, (6 + r6) / 10})});
  expectKnown({"radau_iia_3",
               square(3, {(88 - 7 * r6) / 360, (296 - 169 * r6) / 1800, (-2 + 3 * r6) / 225, (296 + 169 * r6) / 1800,
                          (88 + 7 * r6) / 360, (-2 - 3 * r6) / 225, (16 - r6) / 36, (16 + r6) / 36, one / 9}),
               column({(16 - r6) / 36, (16 + r6) / 36, one / 9}), column({(4 - r6) / 10, (4 + r6) / 10, 1})});
}

// HW II, tables IV.5.8 to IV.5.12; IIIC* and IIID: Chan, BIT 30 (1990), and their mean.
TEST(Families, EqualTheFractionsOfTheBooks) {
  const BigFloat one = 1;
  const Vec<BigFloat> b = column({one / 6, 2 * one / 3, one / 6}), c = column({0, one / 2, 1});
  const Mat<BigFloat> iiic =
      square(3, {one / 6, -one / 3, one / 6, one / 6, 5 * one / 12, -one / 12, one / 6, 2 * one / 3, one / 6});
  const Mat<BigFloat> iiics = square(3, {0, 0, 0, one / 4, one / 4, 0, 0, 1, 0});
  expectKnown(
      {"lobatto_iiia_3", square(3, {0, 0, 0, 5 * one / 24, one / 3, -one / 24, one / 6, 2 * one / 3, one / 6}), b, c});
  expectKnown(
      {"lobatto_iiib_3", square(3, {one / 6, -one / 6, 0, one / 6, one / 3, 0, one / 6, 5 * one / 6, 0}), b, c});
  expectKnown({"lobatto_iiic_3", iiic, b, c});
  expectKnown({"lobatto_iiics_3", iiics, b, c});
  expectKnown({"lobatto_iiid_3", (iiic + iiics) / BigFloat(2), b, c});
}

TEST(Families, OneStageMembers) {
  const BigFloat one = 1;
  expectKnown({"gauss_1", square(1, {one / 2}), column({1}), column({one / 2})});
  expectKnown({"radau_ia_1", square(1, {1}), column({1}), column({0})});
  expectKnown({"radau_iia_1", square(1, {1}), column({1}), column({1})});
}

}  // namespace
}  // namespace irk
