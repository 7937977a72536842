#include "tableaus/analysis/analysis.h"

#include <cmath>
#include <limits>

#include "tests/tableaus/support.h"

namespace irk {
namespace {

TEST(Analysis, StructureOfTheory) {
  struct Row {
    std::string family;
    bool algebraically_stable, symplectic, stiffly_accurate, regular, explicit_first_stage;
  };
  const Row theory[] = {
      {"gauss", true, true, false, true, false},           {"radau_ia", true, false, false, true, false},
      {"radau_iia", true, false, true, true, false},       {"lobatto_iiia", false, false, true, false, true},
      {"lobatto_iiib", false, false, false, false, false}, {"lobatto_iiic", true, false, true, true, false},
      {"lobatto_iiics", false, false, false, false, true}, {"lobatto_iiid", true, true, false, true, false}};
  ASSERT_EQ(std::size(theory), families().size());
  for (const Row& row : theory) {
    for (Index s : {2, 3, 4, 9, 20}) {
      SCOPED_TRACE(memberId(row.family, s));
      const auto analysis = analyzeTableau(makeTableau<double>(memberId(row.family, s)));
      EXPECT_EQ(analysis.algebraically_stable, row.algebraically_stable);
      EXPECT_EQ(analysis.symplectic, row.symplectic);
      EXPECT_EQ(analysis.stiffly_accurate, row.stiffly_accurate);
      EXPECT_EQ(analysis.regular, row.regular);
      EXPECT_EQ(analysis.explicit_first_stage, row.explicit_first_stage);
    }
  }
}

TEST(Analysis, OneStageRadauIaIsStifflyAccurate) {
  const auto analysis = analyzeTableau(makeTableau<double>("radau_ia_1"));
  EXPECT_TRUE(analysis.stiffly_accurate);
  EXPECT_EQ(analysis.q, 0);
}

Tableau<double> userTableau(const Mat<double>& A, const Vec<double>& b, int order) {
  return {"user", "user", A, b, A.rowwise().sum(), order, 1};
}

// Alexander, SIAM J. Numer. Anal. 14 (1977): order 2 with gamma = 1 - 1/sqrt(2), L-stable.
TEST(Analysis, DiagonallyImplicit) {
  const double gamma = 1 - 1 / std::sqrt(2.0);
  Mat<double> A(2, 2);
  A << gamma, 0, 1 - gamma, gamma;
  const auto analysis = analyzeTableau(userTableau(A, A.row(1).transpose(), 2));
  EXPECT_EQ(analysis.p, 2);
  EXPECT_EQ(analysis.q, 1);
  EXPECT_EQ(analysis.r, 0);
  EXPECT_EQ(analysis.proven_order, 2);
  EXPECT_TRUE(analysis.stiffly_accurate);
}

// Kutta's method has order 4, but B(4), C(1) and D(1) prove no more than 3.
TEST(Analysis, ExplicitMethod) {
  Mat<double> A = Mat<double>::Zero(4, 4);
  A(1, 0) = A(2, 1) = 0.5;
  A(3, 2) = 1;
  const Vec<double> b = Vec<double>{{1, 2, 2, 1}} / 6.0;
  const auto analysis = analyzeTableau(userTableau(A, b, 4));
  EXPECT_EQ(analysis.p, 4);
  EXPECT_EQ(analysis.q, 1);
  EXPECT_EQ(analysis.r, 1);
  EXPECT_EQ(analysis.proven_order, 3);
  EXPECT_TRUE(analysis.explicit_first_stage);
  EXPECT_FALSE(analysis.regular);
}

TEST(Analysis, SymplecticityErrorIsMeasured) {
  auto tableau = makeTableau<double>("gauss_3");
  const double delta = 1e-9;
  tableau.A(0, 1) += delta;
  const auto analysis = analyzeTableau(tableau);
  EXPECT_NEAR(analysis.symplecticity_error, delta * tableau.b[0], analysis.tolerance);
  EXPECT_FALSE(analysis.symplectic);
}

TEST(Analysis, RefusesWrongShapesAndValues) {
  auto tableau = makeTableau<double>("gauss_3");
  tableau.A(1, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(contains(refusal([&] { analyzeTableau(tableau); }), "not finite"));
  tableau = makeTableau<double>("gauss_3");
  tableau.c.conservativeResize(2);
  EXPECT_TRUE(contains(refusal([&] { analyzeTableau(tableau); }), "c has 2 entries"));
}

// The condition in the 1-norm, by hand. Radau IIA, s = 2: A = (5, -1; 9, 3) / 12 has the norm 7/6, its inverse (3, 1;
// -9, 5) / 2 the norm 6. Gauss, s = 1: A = 1/2. Lobatto IIIA: singular.
TEST(Condition, OfSmallMatrices) {
  const auto reciprocal = [](const char* method) {
    return analyzeTableau(makeTableau<double>(method)).reciprocal_condition;
  };
  EXPECT_NEAR(reciprocal("radau_iia_2"), 1.0 / 7, 1e-14);
  EXPECT_NEAR(reciprocal("gauss_1"), 1, 1e-14);
  EXPECT_EQ(reciprocal("lobatto_iiia_2"), 0);
}

}  // namespace
}  // namespace irk
