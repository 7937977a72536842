// The condition of A in the 1-norm, by hand.
#include "tableaus/analysis/analysis.h"
#include "tests/tableaus/support.h"

namespace irk {
namespace {

// Radau IIA, s = 2: A = (5, -1; 9, 3) / 12 has the norm 7/6, its inverse (3, 1; -9, 5) / 2 the norm 6.
// Gauss, s = 1: A = 1/2. Lobatto IIIA: singular.
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
