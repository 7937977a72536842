// Legendre polynomials on [0, 1].
#include "core/legendre.h"

#include <gtest/gtest.h>

#include <cmath>

namespace irk::test {
namespace {

// Coefficients from a table and, beyond it, computed.
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

}  // namespace
}  // namespace irk::test
