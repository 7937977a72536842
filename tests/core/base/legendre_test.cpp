// Legendre polynomials on [0, 1].
#include "core/base/legendre.h"

#include <gtest/gtest.h>

#include <cmath>

#include "irk/tableaus.h"

namespace irk::test {
namespace {

// Checks tabulated coefficients and, beyond the table, computed ones.
TEST(Legendre, AgreesWithTheStandardLibrary) {
  Vec<double> p(45);
  for (const double x : {0.0, 0.3, 0.77, 1.0}) {
    legendre<double>(x, p);
    for (Index k = 0; k < p.size(); ++k) {
      const double normal = std::sqrt(2 * static_cast<double>(k) + 1);
      const double expected = normal * std::legendre(static_cast<unsigned>(k), 2 * x - 1);
      EXPECT_NEAR(p[k], expected, 1e-13 * normal) << k << " at " << x;
    }
  }
}

// Compares with quadrature: four panels of a Gauss method of order 40.
TEST(Legendre, IntegralsAreThoseOfQuadrature) {
  const auto gauss = makeTableau<double>("gauss_20");
  constexpr Index kStages = 40;
  constexpr int kPanels = 4;
  Vec<double> p(kStages + 2), once(kStages + 1), twice(kStages), at(kStages + 2);
  for (const double x : {0.0, 0.3, 0.77, 1.0}) {
    legendre<double>(x, p);
    integrateLegendre(p, once, twice);
    Vec<double> expected = Vec<double>::Zero(kStages), second = expected;
    for (int panel = 0; panel < kPanels; ++panel) {
      for (Index i = 0; i < gauss.stages(); ++i) {
        const double tau = x * (panel + gauss.c[i]) / kPanels, weight = x * gauss.b[i] / kPanels;
        legendre<double>(tau, at);
        expected += weight * at.head(kStages);
        second += weight * (x - tau) * at.head(kStages);  // int int f = int (x - tau) f
      }
    }
    for (Index k = 0; k < kStages; ++k) {
      EXPECT_NEAR(once[k], expected[k], 1e-13) << k << " at " << x;
      EXPECT_NEAR(twice[k], second[k], 1e-13) << k << " at " << x;
    }
  }
}

}  // namespace
}  // namespace irk::test
