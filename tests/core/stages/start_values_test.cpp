// Start values from the step before, against Lagrange's interpolation in 50 digits.
#include "core/stages/start_values.h"

#include <gtest/gtest.h>

#include <string>

#include "irk/multiprecision.h"
#include "tests/core/support.h"

namespace irk::test {
namespace {

// The polynomial through the stages (c_i, w_i) of one row, at tau.
double lagrange(const Vec<double>& c, const Mat<double>& W, Index row, double tau) {
  mp50 sum(0);
  for (Index i = 0; i < c.size(); ++i) {
    mp50 term(W(row, i));
    for (Index j = 0; j < c.size(); ++j) {
      if (j != i) term *= (mp50(tau) - mp50(c[j])) / (mp50(c[i]) - mp50(c[j]));
    }
    sum += term;
  }
  return static_cast<double>(sum);
}

Scheme<double> radau(Index s) { return Scheme<double>(makeTableau<double>("radau_iia_" + std::to_string(s))); }

// How far the polynomial of the farthest stage is from the stages: the sum of the absolute weights.
double amplification(const Scheme<double>& past, double tau) {
  double sum = 0;
  for (Index i = 0; i < past.s; ++i) {
    sum += std::abs(lagrange(past.c, Mat<double>::Identity(past.s, past.s), i, tau));
  }
  return sum;
}

// Few unknowns with many stages take the products in the other order.
TEST(StartValues, ExtrapolateThePolynomialOfTheStepBefore) {
  for (const Index n : {1, 2, 3, 8}) {
    for (const Index before : {1, 2, 3, 4, 7, 13}) {
      for (const Index s : {2, 3, 7}) {
        const Scheme<double> past_scheme = radau(before), scheme = radau(s);
        StartValues<double> start(Predictor::kExtrapolated, scheme);
        StagePolynomial<double> past{&past_scheme, 2, 0.5, Mat<double>::Random(n, before), true};
        State<double> from(Sizes{.nx = n});
        from.t = 2.5;
        for (const double h : {0.5, 0.1, 0.5, 0.75}) {
          const double farthest = 1 + h / past.h;
          const double amplified = amplification(past_scheme, farthest);
          if (amplified > 5e3) continue;  // see the next test
          Mat<double> W(n, s);
          start.fill(past, from, h, W);
          for (Index j = 0; j < s; ++j) {
            for (Index i = 0; i < n; ++i) {
              const double expected = lagrange(past_scheme.c, past.W, i, 1 + scheme.c[j] * h / past.h);
              EXPECT_NEAR(W(i, j), expected, 1e-14 * amplified) << n << " " << before << " " << s << " " << h;
            }
          }
        }
      }
    }
  }
}

// Where the full polynomial amplifies too much, its highest degrees are left out: the same ones in both orders of the
// products.
TEST(StartValues, AmplifyUpToALimitInBothOrdersOfTheProducts) {
  for (const Index s : {7, 10, 13}) {
    for (const double ratio : {2.0, 8.0}) {
      const Scheme<double> scheme = radau(s);
      ASSERT_GT(amplification(scheme, 1 + ratio), 1e4);
      const Mat<double> rows = Mat<double>::Random(8, s);
      const auto filled = [&](Index n) {
        StartValues<double> start(Predictor::kExtrapolated, scheme);
        const StagePolynomial<double> past{&scheme, 0, 1, rows.topRows(n), true};
        State<double> from(Sizes{.nx = n});
        from.t = 1;
        Mat<double> W(n, s);
        start.fill(past, from, ratio, W);
        return W;
      };
      const Mat<double> few = filled(2), many = filled(8);
      EXPECT_LT((few - many.topRows(2)).cwiseAbs().maxCoeff(), 1e-10) << s << " " << ratio;
      EXPECT_LT(many.cwiseAbs().maxCoeff(), 1e4) << s << " " << ratio;
      EXPECT_GT(many.cwiseAbs().maxCoeff(), 1) << s << " " << ratio;
      // Constants and straight lines are kept whole.
      const Mat<double> line = Mat<double>::Ones(2, 1) * (scheme.c.transpose().array() * 3 - 1).matrix();
      StartValues<double> start(Predictor::kExtrapolated, scheme);
      const StagePolynomial<double> past{&scheme, 0, 1, line, true};
      State<double> from(Sizes{.nx = 2});
      from.t = 1;
      Mat<double> W(2, s);
      start.fill(past, from, ratio, W);
      for (Index j = 0; j < s; ++j) EXPECT_NEAR(W(1, j), 3 * (1 + ratio * scheme.c[j]) - 1, 1e-10) << s;
    }
  }
}

}  // namespace
}  // namespace irk::test
