// Start values from the step before, against Lagrange's interpolation in 50 digits.
#include "core/stages/start_values.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "core/base/legendre.h"
#include "irk/multiprecision.h"
#include "tests/core/support.h"

namespace irk::test {
namespace {

// The polynomial through the stages (c_i, w_i) of one row, at tau.
double lagrange(const Vec<double>& c, const Mat<double>& W, Index row, double tau) {
  BigFloat sum(0);
  for (Index i = 0; i < c.size(); ++i) {
    BigFloat term(W(row, i));
    for (Index j = 0; j < c.size(); ++j) {
      if (j != i) term *= (BigFloat(tau) - BigFloat(c[j])) / (BigFloat(c[i]) - BigFloat(c[j]));
    }
    sum += term;
  }
  return static_cast<double>(sum);
}

Scheme<double> radau(Index s) { return Scheme<double>(makeTableau<double>("radau_iia_" + std::to_string(s))); }

// The sum of the absolute Lagrange weights at tau.
double amplification(const Scheme<double>& past, double tau) {
  double sum = 0;
  for (Index i = 0; i < past.s; ++i) {
    sum += std::abs(lagrange(past.c, Mat<double>::Identity(past.s, past.s), i, tau));
  }
  return sum;
}

// The start values of a step of size h from t.
Mat<double> filled(StartValues<double>& start, const Scheme<double>& scheme, const StagePolynomial<double>& past,
                   double t, double h) {
  const Index n = past.W.rows();
  State<double> from(Sizes{.nx = n});
  from.t = t;
  Mat<double> W = Mat<double>::Constant(n, scheme.s, 77);
  start.fill(past, from, h, W);
  return W;
}

// Few unknowns with many stages take the products in the other order. One object serves for all steps before; the same
// step twice takes what was kept.
TEST(StartValues, ExtrapolateThePolynomialOfTheStepBefore) {
  for (const Index n : {1, 2, 3, 8}) {
    for (const Index s : {2, 3, 7}) {
      const Scheme<double> scheme = radau(s);
      StartValues<double> start(Predictor::kExtrapolated, scheme, 0);
      std::vector<std::unique_ptr<const Scheme<double>>> all;  // schemes are recognized by their addresses
      for (const Index before : {7, 1, 13, 2, 4, 3}) {
        all.push_back(std::make_unique<const Scheme<double>>(radau(before)));
        const Scheme<double>& past_scheme = *all.back();
        const StagePolynomial<double> past{&past_scheme, 2, 0.5, Mat<double>::Random(n, before), true};
        for (const double t : {2.5, 2.25, 2.0}) {
          for (const double h : {0.5, 0.1, 0.1, 0.75}) {
            const double amplified = amplification(past_scheme, (t + h - 2) / 0.5);
            if (amplified > 5e3) continue;  // see the next test
            const Mat<double> W = filled(start, scheme, past, t, h);
            for (Index j = 0; j < s; ++j) {
              for (Index i = 0; i < n; ++i) {
                const double expected = lagrange(past_scheme.c, past.W, i, (t + scheme.c[j] * h - 2) / 0.5);
                EXPECT_NEAR(W(i, j), expected, 1e-13 * (1 + amplified)) << n << " " << before << " " << s << " " << h;
              }
            }
          }
        }
      }
    }
  }
}

// The largest number of leading Legendre polynomials whose weights at tau amplify by at most the limit.
Index degreesAllowed(const Scheme<double>& past, double tau, double limit) {
  Vec<double> basis(past.s);
  legendre<double>(tau, basis);
  for (Index k = 1; k < past.s; ++k) {
    const Vec<double> row = past.legendre_inverse.topRows(k + 1).transpose() * basis.head(k + 1);
    if (row.cwiseAbs().sum() > limit) return k;
  }
  return past.s;
}

// Where the full polynomial amplifies too much, its highest degrees are left out: Legendre polynomials below the
// allowed degree are continued exactly, the next one is left out.
TEST(StartValues, AmplifyUpToALimitInBothOrdersOfTheProducts) {
  for (const Index s : {7, 10, 13}) {
    for (const double ratio : {2.0, 8.0}) {
      for (const auto& [n, tolerance, limit] :
           {std::tuple(2, 0.0, 1e4), {8, 1e-9, 1e4}, {2, 1e-2, 1e2}, {8, 1e-2, 1e2}}) {
        SCOPED_TRACE(std::to_string(s) + " " + std::to_string(ratio) + " " + std::to_string(n));
        const Scheme<double> scheme = radau(s);
        ASSERT_GT(amplification(scheme, 1 + ratio), limit);
        const Index allowed = degreesAllowed(scheme, 1 + ratio, limit);
        ASSERT_GT(allowed, 1);
        ASSERT_LT(allowed, s);
        StartValues<double> start(Predictor::kExtrapolated, scheme, tolerance);
        for (Index degree = 0; degree <= allowed; ++degree) {
          Vec<double> p(degree + 1);
          const auto value = [&](double tau) {
            legendre<double>(tau, p);
            return p[degree];
          };
          StagePolynomial<double> past{&scheme, 2, 0.5, Mat<double>(n, s), true};
          for (Index i = 0; i < s; ++i) past.W.col(i).setConstant(value(scheme.c[i]));
          const Mat<double> W = filled(start, scheme, past, 2.5, ratio * 0.5);
          for (Index j = 0; j < s; ++j) {
            const double exact = value(1 + ratio * scheme.c[j]), expected = degree < allowed ? exact : 0;
            EXPECT_NEAR(W(n - 1, j), expected, 1e-10 * (1 + std::abs(exact))) << degree;
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace irk::test
