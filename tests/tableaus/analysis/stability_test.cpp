// R(z), stability, eigenvalues and symmetry: Hairer & Wanner II, IV.3 to IV.6.
#include "tableaus/analysis/stability.h"

#include <cmath>
#include <limits>

#include "tableaus/analysis/properties.h"
#include "tableaus/catalogue/report.h"
#include "tableaus/files/file.h"
#include "tests/tableaus/support.h"

namespace irk {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

TableauProperties propertiesOf(const Tableau<BigFloat>& tableau) {
  return analyzeProperties(tableau, roundingTolerance<BigFloat>());
}

/// Makes a tableau from the rows of A, then b; c is the row sums.
Tableau<BigFloat> method(const std::vector<std::vector<BigFloat>>& rows) {
  const auto s = static_cast<Index>(rows.size()) - 1;
  Tableau<BigFloat> tableau{"mine", "user", Mat<BigFloat>(s, s), Vec<BigFloat>(s), Vec<BigFloat>(s), 1, 0};
  for (Index i = 0; i < s; ++i) {
    for (Index j = 0; j < s; ++j) {
      tableau.A(i, j) = rows[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    }
    tableau.b[i] = rows.back()[static_cast<std::size_t>(i)];
  }
  tableau.c = tableau.A.rowwise().sum();
  return tableau;
}

/// Two stages, one value on the diagonal, order 2: b = (1/2, 1/2) on c = (gamma, 1 - gamma).
Tableau<BigFloat> sdirk2(const BigFloat& gamma) {
  return method({{gamma, 0}, {1 - 2 * gamma, gamma}, {BigFloat(1) / 2, BigFloat(1) / 2}});
}

struct Degrees {
  std::string family;
  Index numerator_gap, denominator_gap;
};
const Degrees kPade[] = {{"gauss", 0, 0},        {"radau_ia", 1, 0},     {"radau_iia", 1, 0},    {"lobatto_iiia", 1, 1},
                         {"lobatto_iiib", 1, 1}, {"lobatto_iiic", 2, 0}, {"lobatto_iiics", 0, 2}};

// HW II (IV.3.30): N_jk = sum_i binom(j, i) (j+k-i)! / (j+k)! z^i, D_jk(z) = N_kj(-z).
BigFloat padeCoefficient(Index j, Index k, Index i) {
  BigFloat value = 1;
  for (Index m = 0; m < i; ++m) value *= BigFloat(j - m) / ((j + k - m) * (m + 1));
  return value;
}

// HW II, Theorem IV.3.11: e^z - R = (-1)^k j! k! / ((j+k)! (j+k+1)!) z^(j+k+1) + ...
BigFloat padeConstant(Index j, Index k) {
  BigFloat value = k % 2 == 0 ? 1 : -1;
  for (Index m = 1; m <= j; ++m) value *= m;
  for (Index m = 1; m <= k; ++m) value *= m;
  for (Index m = 1; m <= j + k; ++m) value /= m;
  for (Index m = 1; m <= j + k + 1; ++m) value /= m;
  return value;
}

TEST(StabilityFunction, FamiliesArePadeApproximations) {
  for (const auto& [family, numerator_gap, denominator_gap] : kPade) {
    for (Index s = familyOf(family).minStages(); s <= 20; ++s) {
      SCOPED_TRACE(memberId(family, s));
      const auto R = stabilityFunction(constructFamily(familyOf(family), s), 5e-48);
      const Index j = s - numerator_gap, k = s - denominator_gap;
      ASSERT_EQ(R.numeratorDegree(), j);
      ASSERT_EQ(R.denominatorDegree(), k);
      EXPECT_TRUE(R.isPade());
      for (Index i = 0; i <= j; ++i) {
        EXPECT_LT(abs(R.numerator[i] / padeCoefficient(j, k, i) - 1), 1e-40) << i;
      }
      for (Index i = 0; i <= k; ++i) {
        const BigFloat sign = i % 2 == 0 ? 1 : -1;
        EXPECT_LT(abs(sign * R.denominator[i] / padeCoefficient(k, j, i) - 1), 1e-40) << i;
      }
      EXPECT_NEAR(R.error_constant / static_cast<double>(padeConstant(j, k)), 1, 1e-14);
    }
  }
}

// (IIIC + IIIC*) / 2: R(z) R(-z) = 1 with the error constant of neither a (s, s) approximation.
TEST(StabilityFunction, LobattoIiidIsSymmetricAndNoPadeApproximation) {
  for (Index s = 2; s <= 20; ++s) {
    const auto R = stabilityFunction(constructFamily(familyOf("lobatto_iiid"), s), 5e-48);
    ASSERT_EQ(R.numeratorDegree(), s);
    ASSERT_EQ(R.denominatorDegree(), s);
    EXPECT_EQ(R.order, 2 * s - 2);
    EXPECT_FALSE(R.isPade());
    for (Index i = 0; i <= s; ++i) {
      const BigFloat sign = i % 2 == 0 ? 1 : -1;
      EXPECT_LT(abs(sign * R.denominator[i] / R.numerator[i] - 1), 1e-40) << s << ' ' << i;
    }
  }
}

TEST(StabilityFunction, ZerosAndPolesGiveItsValues) {
  for (const auto& family : families()) {
    const auto R = stabilityFunction(constructFamily(family, 6), 5e-48);
    const std::complex<double> z(-0.7, 1.3);
    std::complex<double> product = 1, N = 0, D = 0;
    for (const auto& zero : R.zeros) product *= 1.0 - z / zero;
    for (const auto& pole : R.poles) product /= 1.0 - z / pole;
    for (Index i = R.numeratorDegree(); i >= 0; --i) {
      N = N * z + static_cast<double>(R.numerator[i]);
    }
    for (Index i = R.denominatorDegree(); i >= 0; --i) {
      D = D * z + static_cast<double>(R.denominator[i]);
    }
    EXPECT_LT(std::abs(product - N / D), 1e-13) << family.id;
  }
}

double limitOfTheory(const std::string& family, Index s) {
  const auto alternating = [](Index exponent) { return exponent % 2 == 0 ? 1.0 : -1.0; };
  if (family == "gauss" || family == "lobatto_iiid") return alternating(s);
  if (family == "lobatto_iiia" || family == "lobatto_iiib") return alternating(s - 1);
  return family == "lobatto_iiics" ? kInf : 0;
}

TEST(StabilityFunction, LimitsOfTheory) {
  for (const Family& family : families()) {
    for (const Index s : {2, 3, 4, 5, 10, 15}) {
      const auto R = stabilityFunction(constructFamily(family, s), 5e-48);
      const double expected = limitOfTheory(family.id, s);
      if (expected == kInf) {
        EXPECT_EQ(std::abs(R.atInfinity()), kInf) << memberId(family.id, s);
      } else {
        EXPECT_NEAR(R.atInfinity(), expected, 1e-15) << memberId(family.id, s);
      }
    }
  }
}

// A singular A of another kind: the trapezoidal rule with its first stage repeated.
TEST(StabilityFunction, LimitWithARepeatedExplicitStage) {
  const BigFloat quarter = BigFloat(1) / 4, half = BigFloat(1) / 2;
  const auto R =
      stabilityFunction(method({{0, 0, 0}, {0, 0, 0}, {quarter, quarter, half}, {quarter, quarter, half}}), 5e-48);
  EXPECT_EQ(R.atInfinity(), -1);
}

// Two equal stages: the method reduces to the implicit midpoint rule, so N and D have a common factor.
TEST(StabilityFunction, CommonFactorsCancel) {
  const BigFloat half = BigFloat(1) / 2;
  const auto R = stabilityFunction(method({{half, 0}, {0, half}, {half, half}}), 5e-48);
  ASSERT_EQ(R.numeratorDegree(), 1);
  ASSERT_EQ(R.denominatorDegree(), 1);
  EXPECT_EQ(R.atInfinity(), -1);
}

TEST(StabilityFunction, RoundedToDoubleKeepsItsDegrees) {
  for (const auto& [family, numerator_gap, denominator_gap] : kPade) {
    for (Index s : {2, 5, 10, 20}) {
      const auto rounded = makeTableau<double>(memberId(family, s)).cast<BigFloat>();
      const auto R = stabilityFunction(rounded, roundingTolerance<double>());
      EXPECT_EQ(R.numeratorDegree(), s - numerator_gap) << family << s;
      EXPECT_EQ(R.denominatorDegree(), s - denominator_gap) << family << s;
      EXPECT_LE(R.order, 2 * s - numerator_gap - denominator_gap) << family << s;
    }
  }
}

// Theory: all families but Lobatto IIIC* are A-stable; those with R(inf) = 0 are L-stable.
TEST(Stability, OfTheFamilies) {
  for (const auto& family : families()) {
    const bool a_stable = family.id != "lobatto_iiics";
    const bool l_stable = family.id.starts_with("radau") || family.id == "lobatto_iiic";
    for (Index s = family.minStages(); s <= 20; ++s) {
      SCOPED_TRACE(memberId(family.id, s));
      const auto stability = analyzeStability(stabilityFunction(constructFamily(family, s), 5e-48), 5e-48);
      EXPECT_EQ(stability.a_stable, a_stable);
      EXPECT_EQ(stability.l_stable, l_stable);
      EXPECT_EQ(stability.i_stable, a_stable);
      EXPECT_EQ(stability.alpha == 90, a_stable);
    }
  }
}

// Explicit methods with s = p <= 4 stages: HW II, Table IV.2.1.
TEST(Stability, IntervalsOfExplicitMethods) {
  const BigFloat half = BigFloat(1) / 2, third = BigFloat(1) / 3, sixth = BigFloat(1) / 6;
  const auto rk4 = propertiesOf(
      method({{0, 0, 0, 0}, {half, 0, 0, 0}, {0, half, 0, 0}, {0, 0, 1, 0}, {sixth, third, third, sixth}}));
  EXPECT_NEAR(rk4.stability.real_limit, 2.785293563405282, 1e-14);
  EXPECT_NEAR(rk4.stability.imaginary_limit, 2 * std::sqrt(2.0), 1e-14);
  EXPECT_FALSE(rk4.stability.a_stable);
  EXPECT_TRUE(std::isnan(rk4.stability.alpha));
  EXPECT_EQ(rk4.R.denominatorDegree(), 0);
  EXPECT_NEAR(rk4.R.error_constant, 1.0 / 120, 1e-16);
  EXPECT_EQ(rk4.R.atInfinity(), kInf);
  EXPECT_EQ(rk4.kind, StageKind::kExplicit);
  EXPECT_FALSE(rk4.quadrature.distinct);
  EXPECT_TRUE(rk4.spectrum.defective);

  const auto euler = propertiesOf(method({{0}, {1}}));
  EXPECT_EQ(euler.stability.real_limit, 2);
  EXPECT_EQ(euler.stability.imaginary_limit, 0);
  EXPECT_EQ(euler.R.atInfinity(), -kInf);
}

// HW II, IV.6: of order 2, A-stable for gamma >= 1/4; of order 3 for gamma = (3 + sqrt 3) / 6, not
// for the other sign.
TEST(Stability, OfTwoStageSdirk) {
  EXPECT_TRUE(propertiesOf(sdirk2(BigFloat(1) / 4)).stability.a_stable);
  EXPECT_FALSE(propertiesOf(sdirk2(BigFloat(1) / 4 - BigFloat(1e-12))).stability.a_stable);
  const auto crouzeix = propertiesOf(sdirk2((3 + sqrt(BigFloat(3))) / 6));
  EXPECT_TRUE(crouzeix.stability.a_stable);
  EXPECT_FALSE(crouzeix.stability.l_stable);
  EXPECT_EQ(crouzeix.R.order, 3);
  EXPECT_NEAR(crouzeix.R.atInfinity(), 1 - std::sqrt(3.0), 1e-15);
  EXPECT_EQ(crouzeix.kind, StageKind::kSinglyDiagonal);
  const auto other = propertiesOf(sdirk2((3 - sqrt(BigFloat(3))) / 6));
  EXPECT_EQ(other.R.order, 3);
  EXPECT_FALSE(other.stability.a_stable);
  EXPECT_NEAR(other.R.atInfinity(), 1 + std::sqrt(3.0), 1e-14);
}

// Alexander's L-stable method with a wrong sign: still R(inf) = 0, but unstable on the imaginary axis. Rays just
// above alpha are unstable somewhere, rays just below nowhere.
TEST(Stability, AngleAgreesWithSampling) {
  const BigFloat gamma("0.435866521508458999416019451194"), tau = (1 + gamma) / 2;
  const BigFloat b1 = -(6 * gamma * gamma - 16 * gamma + 1) / 4;
  const BigFloat b2 = (6 * gamma * gamma - 20 * gamma + 5) / 4;
  const auto properties =
      propertiesOf(method({{gamma, 0, 0}, {tau - gamma, gamma, 0}, {b1, -b2, gamma}, {b1, -b2, gamma}}));
  const auto& [a_stable, l_stable, i_stable, alpha, real_limit, imaginary_limit] = properties.stability;
  ASSERT_FALSE(a_stable);
  ASSERT_GT(alpha, 0);
  ASSERT_LT(alpha, 90);
  const auto largest = [&](double degrees) {
    double most = 0;
    for (double r = 1e-3; r < 1e4; r *= 1.001) {
      const auto z = -std::polar(r, degrees * std::acos(-1.0) / 180);
      std::complex<double> value = 1;
      for (const auto& zero : properties.R.zeros) value *= 1.0 - z / zero;
      for (const auto& pole : properties.R.poles) value /= 1.0 - z / pole;
      most = std::max(most, std::abs(value));
    }
    return most;
  };
  EXPECT_LE(largest(alpha - 0.1), 1);
  EXPECT_GT(largest(alpha + 0.1), 1);
}

// Condition of the unit eigenvectors of Gauss in the 2-norm.
TEST(Spectrum, ConditionOfEigenvectors) {
  const auto conditionOf = [](Index s) {
    return spectrum(constructFamily(familyOf("gauss"), s).A, 5e-48).eigenvector_condition;
  };
  EXPECT_NEAR(conditionOf(5) / 1.7e2, 1, 0.05);
  EXPECT_NEAR(conditionOf(10) / 1.1e5, 1, 0.05);
  EXPECT_NEAR(conditionOf(20) / 5.6e10, 1, 0.05);
}

TEST(Spectrum, RepeatedEigenvaluesWithAndWithoutEigenvectors) {
  const Mat<BigFloat> diagonal = Mat<BigFloat>::Identity(3, 3) / 2;
  EXPECT_TRUE(spectrum(diagonal, 5e-48).repeated);
  EXPECT_FALSE(spectrum(diagonal, 5e-48).defective);
  EXPECT_EQ(spectrum(diagonal, 5e-48).eigenvector_condition, 1);
  EXPECT_TRUE(spectrum(sdirk2(BigFloat(1) / 4).A, 5e-48).defective);
  Mat<BigFloat> sdirk = Mat<BigFloat>::Ones(6, 6).triangularView<Eigen::Lower>();
  sdirk.diagonal().setConstant(BigFloat(1) / 3);
  EXPECT_TRUE(spectrum(sdirk, 5e-48).defective);
  EXPECT_EQ(spectrum(sdirk, 5e-48).gap, 0);
  // Not triangular, and rounded to double; both eigenvalues are 1.
  Mat<BigFloat> full(2, 2);
  full << 3, 4, -1, -1;
  full(0, 0) += BigFloat(1e-16);
  EXPECT_TRUE(spectrum(full, roundingTolerance<double>()).defective);
  EXPECT_FALSE(spectrum(full, 5e-48).defective) << "as 80 digits see it";
}

TEST(Structure, SymmetryOfTheFamilies) {
  for (const auto& family : families()) {
    const bool symmetric = family.id == "gauss" || family.id == "lobatto_iiia" || family.id == "lobatto_iiib" ||
                           family.id == "lobatto_iiid";
    for (Index s : {2, 3, 6, 11}) {
      EXPECT_EQ(propertiesOf(constructFamily(family, s)).symmetric, symmetric) << family.id << s;
    }
  }
}

// Composition of two midpoint rules: no collocation method, stages in any order.
TEST(Structure, SymmetryUpToTheOrderOfStages) {
  const BigFloat quarter = BigFloat(1) / 4, half = BigFloat(1) / 2;
  const auto composed = method({{quarter, 0}, {half, quarter}, {half, half}});
  EXPECT_TRUE(propertiesOf(composed).symmetric);
  const auto swapped = method({{quarter, half}, {0, quarter}, {half, half}});
  EXPECT_TRUE(propertiesOf(swapped).symmetric);
  EXPECT_EQ(propertiesOf(swapped).kind, StageKind::kFull);
  EXPECT_FALSE(propertiesOf(sdirk2(BigFloat(1) / 3)).symmetric);
}

TEST(Structure, KindsOfStages) {
  EXPECT_EQ(propertiesOf(method({{0, 0}, {BigFloat(1) / 2, BigFloat(1) / 2}, {0, 1}})).kind,
            StageKind::kSinglyDiagonalRest);
  EXPECT_EQ(propertiesOf(method({{1, 0}, {1, 2}, {0, 1}})).kind, StageKind::kDiagonal);
  EXPECT_EQ(propertiesOf(constructFamily(familyOf("gauss"), 2)).kind, StageKind::kFull);
}

TEST(Properties, TooManyStagesAreRefusedOrReported) {
  EXPECT_TRUE(contains(refusal([] { propertiesOf(constructFamily(familyOf("gauss"), 41)); }),
                       "properties are analysed up to 40"));
  EXPECT_TRUE(contains(checkTableau("gauss_41").text, "analysed up to 40 stages only"));
}

}  // namespace
}  // namespace irk
