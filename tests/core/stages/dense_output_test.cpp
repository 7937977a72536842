// The solution inside a step.
#include "core/stages/dense_output.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/core/support.h"

namespace irk::test {
namespace {

// u'' = 1 + t^(s-1), x' = 2 - t^(s-1) and z = t^(s-1) from t = 0: the highest powers that s stages represent exactly.
struct Powers {
  Index s;
  double h;
  double power(double theta, int integrals) const {
    const double t = theta * h, k = static_cast<double>(s) - 1;
    if (integrals == 0) return std::pow(t, k);
    return integrals == 1 ? std::pow(t, k + 1) / (k + 1) : std::pow(t, k + 2) / ((k + 1) * (k + 2));
  }
  void expect(const State<double>& at, double theta, double accuracy) const {
    const double t = theta * h;
    EXPECT_NEAR(at.t, 3 + t, accuracy);
    EXPECT_NEAR(at.u[0], 5 + 7 * t + t * t / 2 + power(theta, 2), accuracy);
    EXPECT_NEAR(at.v[0], 7 + t + power(theta, 1), accuracy);
    EXPECT_NEAR(at.x[0], 11 + 2 * t - power(theta, 1), accuracy);
    EXPECT_NEAR(at.a()[0], 1 + power(theta, 0), accuracy);
    EXPECT_NEAR(at.k()[0], 2 - power(theta, 0), accuracy);
    EXPECT_NEAR(at.z()[0], power(theta, 0), accuracy);
  }
};

// Tests both interfaces for points inside a step, with one object for several numbers of stages, as in variable
// order.
TEST(DenseOutput, PolynomialsOfTheStagesAreExact) {
  const Sizes sizes{.nu = 1, .nx = 1, .nz = 1};
  DenseOutput<double> dense(sizes);
  State<double> from(sizes), at(sizes);
  from.t = 3;
  from.u[0] = 5, from.v[0] = 7, from.x[0] = 11;
  for (const Index s : {5, 2, 13, 1}) {
    SCOPED_TRACE(s);
    const Scheme<double> scheme(makeTableau<double>("radau_iia_" + std::to_string(s)));
    const Powers powers{s, 0.75};
    StagePolynomial<double> stages{&scheme, 3, powers.h, Mat<double>(3, s), true};
    for (Index i = 0; i < s; ++i) {
      const double p = powers.power(scheme.c[i], 0);
      stages.W.col(i) << 1 + p, 2 - p, p;
    }
    dense.begin(from, stages);
    for (Index j = 1; j < kParts; ++j) {
      const double theta = static_cast<double>(j) / static_cast<double>(kParts);
      dense.evaluateInside(j, at);
      powers.expect(at, theta, 2e-14);
      dense.evaluate(theta, at);
      powers.expect(at, theta, 2e-14);
    }
    for (const double theta : {0.0, 0.3, 1.0}) {
      dense.evaluate(theta, at);
      powers.expect(at, theta, 2e-14);
    }
  }
}

}  // namespace
}  // namespace irk::test
