// The construction against an independent one: nodes from Rodrigues' formula, coefficients from Vandermonde systems,
// in 200 digits because these lose about 0.72 s of them.
#include <Eigen/LU>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

#include "tests/tableaus/support.h"

namespace irk {
namespace {

using wide = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<200>, boost::multiprecision::et_off>;

// 200 digits hold all of x.
template <class Real>
Tableau<wide> widened(const Tableau<Real>& t) {
  const auto wider = [](const Real& x) { return wide(x.str(200)); };
  return {t.id, t.family, t.A.unaryExpr(wider), t.b.unaryExpr(wider), t.c.unaryExpr(wider), t.order, t.stage_order};
}

// All digits of the construction except five.
double tolerance() { return std::pow(10.0, -(WorkingDigits::now() + kSpareDigits - 5)); }

constexpr Index kMaxTestedStages = 16;

/// Coefficients, lowest power first.
using Polynomial = std::vector<wide>;

/// The derivative of order `times` of x^zeros_left (x - 1)^zeros_right.
Polynomial rodrigues(Index zeros_left, Index zeros_right, Index times) {
  Polynomial p(static_cast<std::size_t>(zeros_left), wide(0));
  p.push_back(1);
  for (Index k = 0; k < zeros_right; ++k) {
    p.insert(p.begin(), 0);
    for (std::size_t i = 0; i + 1 < p.size(); ++i) p[i] -= p[i + 1];
  }
  for (Index k = 0; k < times; ++k) {
    for (std::size_t i = 1; i < p.size(); ++i) p[i - 1] = p[i] * i;
    p.pop_back();
  }
  return p;
}

// Hairer & Wanner II, IV.5: shifted Legendre, Radau and Lobatto polynomials.
Polynomial nodePolynomial(const Family& family, Index s) {
  switch (family.quadrature) {
    case Quadrature::kGauss:
      return rodrigues(s, s, s);
    case Quadrature::kRadauLeft:
      return rodrigues(s, s - 1, s - 1);
    case Quadrature::kRadauRight:
      return rodrigues(s - 1, s, s - 1);
    case Quadrature::kLobatto:
      return rodrigues(s - 1, s - 1, s - 2);
  }
  return {};
}

/// p(x) / p'(x).
wide newtonCorrection(const Polynomial& p, const wide& x) {
  wide value = 0, slope = 0;
  for (auto coefficient = p.rbegin(); coefficient != p.rend(); ++coefficient) {
    slope = slope * x + value;
    value = value * x + *coefficient;
  }
  return value / slope;
}

/// Moves every node to its zero and expects only a tiny change.
Vec<wide> polishedNodes(const Family& family, Index s, Vec<wide> c, double tolerance) {
  const Polynomial p = nodePolynomial(family, s);
  for (wide& x : c) {
    EXPECT_LT(abs(newtonCorrection(p, x)), tolerance);
    for (int step = 0; step < 2; ++step) x -= newtonCorrection(p, x);
  }
  return c;
}

/// V_kj = c_j^(k-1), k = 1 .. s.
Mat<wide> vandermonde(const Vec<wide>& c) {
  Mat<wide> V = Mat<wide>::Ones(c.size(), c.size());
  for (Index k = 1; k < c.size(); ++k) V.row(k) = V.row(k - 1).cwiseProduct(c.transpose());
  return V;
}

/// c_i^k / k in row k - 1, k = 1 .. s: what C asks for.
Mat<wide> integrals(const Vec<wide>& c) {
  Mat<wide> I = vandermonde(c) * c.asDiagonal();
  for (Index k = 1; k <= c.size(); ++k) I.row(k - 1) /= wide(k);
  return I;
}

Vec<wide> interpolatoryWeights(const Vec<wide>& c) {
  Vec<wide> moments(c.size());
  for (Index k = 1; k <= c.size(); ++k) moments[k - 1] = wide(1) / k;
  return vandermonde(c).partialPivLu().solve(moments);
}

/// C(s).
Mat<wide> byC(const Vec<wide>& c) { return vandermonde(c).partialPivLu().solve(integrals(c)).transpose(); }

/// D(s): V diag(b) A = (1/k - I) diag(b).
Mat<wide> byD(const Vec<wide>& b, const Vec<wide>& c) {
  Mat<wide> right = -integrals(c);
  for (Index k = 1; k <= c.size(); ++k) right.row(k - 1).array() += wide(1) / k;
  const Mat<wide> left = vandermonde(c) * b.asDiagonal();
  return left.partialPivLu().solve(Mat<wide>(right * b.asDiagonal()));
}

/// C(s-1) and a given column.
Mat<wide> byCAndColumn(const Vec<wide>& c, Index column, const wide& value) {
  Mat<wide> left = vandermonde(c), right = integrals(c);
  left.row(c.size() - 1).setZero();
  left(c.size() - 1, column) = 1;
  right.row(c.size() - 1).setConstant(value);
  return left.partialPivLu().solve(right).transpose();
}

// Hairer & Wanner II, table IV.5.13 states the definitions: IIIC has a_i1 = b_1, IIIC* a_is = 0.
Mat<wide> independentA(const std::string& family, const Vec<wide>& b, const Vec<wide>& c) {
  if (family == "gauss" || family == "radau_iia" || family == "lobatto_iiia") return byC(c);
  if (family == "radau_ia" || family == "lobatto_iiib") return byD(b, c);
  const Mat<wide> iiic = byCAndColumn(c, 0, b[0]);
  const Mat<wide> iiics = byCAndColumn(c, c.size() - 1, 0);
  if (family == "lobatto_iiic") return iiic;
  if (family == "lobatto_iiics") return iiics;
  return (iiic + iiics) / wide(2);
}

void expectIndependent(const Family& family, const Tableau<wide>& tableau, double tolerance) {
  SCOPED_TRACE(tableau.id);
  const Vec<wide> c = polishedNodes(family, tableau.stages(), tableau.c, tolerance);
  const Vec<wide> b = interpolatoryWeights(c);
  EXPECT_LT(largestDifference<wide>(tableau.b, b), tolerance);
  EXPECT_LT(largestDifference<wide>(tableau.A, independentA(family.id, b, c)), tolerance);
}

TEST(Collocation, VandermondeSystemsGiveTheSameTableaus) {
  for (const Family& family : families()) {
    for (Index s = family.minStages(); s <= kMaxTestedStages; ++s) {
      expectIndependent(family, widened(constructFamily(family, s)), tolerance());
    }
  }
}

// Rounded once: half a unit in the 101st digit for coefficients below 1.
TEST(Collocation, MoreWorkingDigitsCarryMoreOfThem) {
  const WorkingDigits digits(100);
  for (const Family& family : families()) {
    for (const Index s : {2, 11, 20}) {
      const auto precise = widened(constructFamily(family, s));
      expectIndependent(family, precise, tolerance());
      const auto rounded = widened(makeTableau<BigFloat>(memberId(family.id, s)));
      EXPECT_LT(largestDifference<wide>(rounded.A, precise.A), 1e-100) << rounded.id;
      EXPECT_LT(largestDifference<wide>(rounded.b, precise.b), 1e-100) << rounded.id;
      EXPECT_LT(largestDifference<wide>(rounded.c, precise.c), 1e-100) << rounded.id;
    }
  }
}

}  // namespace
}  // namespace irk
