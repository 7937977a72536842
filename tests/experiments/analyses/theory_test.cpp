// Compares the formulas with the tables of measured orders, copied by hand.
#include "experiments/analyses/orders/theory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace irk {
namespace {

struct Expected {
  const char* family;
  SystemKind kind;
  char component;
  std::vector<double> orders;  // from the family's smallest s on, to s = 5
};

// For families that start at s = 2 a column has four entries.
const Expected kTable[] = {
    {"gauss", SystemKind::kOde, 'x', {2, 4, 6, 8, 10}},
    {"radau_ia", SystemKind::kOde, 'x', {1, 3, 5, 7, 9}},
    {"radau_iia", SystemKind::kOde, 'x', {1, 3, 5, 7, 9}},
    {"lobatto_iiia", SystemKind::kOde, 'x', {2, 4, 6, 8}},
    {"lobatto_iiib", SystemKind::kOde, 'x', {2, 4, 6, 8}},
    {"lobatto_iiic", SystemKind::kOde, 'x', {2, 4, 6, 8}},
    {"lobatto_iiics", SystemKind::kOde, 'x', {2, 4, 6, 8}},
    {"lobatto_iiid", SystemKind::kOde, 'x', {2, 4, 6, 8}},
    {"gauss", SystemKind::kIndex1, 'z', {2, 2, 4, 4, 6}},
    {"radau_ia", SystemKind::kIndex1, 'z', {1, 2, 3, 4, 5}},
    {"radau_iia", SystemKind::kIndex1, 'z', {1, 3, 5, 7, 9}},
    {"lobatto_iiia", SystemKind::kIndex1, 'z', {2, 4, 6, 8}},
    {"lobatto_iiic", SystemKind::kIndex1, 'z', {2, 4, 6, 8}},
    {"lobatto_iiid", SystemKind::kIndex1, 'z', {2, 4, 4, 6}},
    {"gauss", SystemKind::kIndex2, 'x', {2, 2, 4, 4, 6}},
    {"gauss", SystemKind::kIndex2, 'z', {0, 0, 2, 2, 4}},
    {"radau_ia", SystemKind::kIndex2, 'x', {1, 2, 3, 4, 5}},
    {"radau_ia", SystemKind::kIndex2, 'z', {1, 1, 2, 3, 4}},
    {"radau_iia", SystemKind::kIndex2, 'x', {1, 3, 5, 7, 9}},
    {"radau_iia", SystemKind::kIndex2, 'z', {1, 2, 3, 4, 5}},
    {"lobatto_iiia", SystemKind::kIndex2, 'x', {2, 4, 6, 8}},
    {"lobatto_iiia", SystemKind::kIndex2, 'z', {2, 2, 4, 4}},
    {"lobatto_iiic", SystemKind::kIndex2, 'x', {2, 4, 6, 8}},
    {"lobatto_iiic", SystemKind::kIndex2, 'z', {1, 2, 3, 4}},
    {"lobatto_iiid", SystemKind::kIndex2, 'x', {2, 4, 4, 6}},
    {"lobatto_iiid", SystemKind::kIndex2, 'z', {0, 2, 2, 4}},
    {"gauss", SystemKind::kMechanical3, 'u', {2, 2, 4, 4, 6}},
    {"gauss", SystemKind::kMechanical3, 'v', {0, 0, 2, 2, 4}},
    {"gauss", SystemKind::kMechanical3, 'z', {-2, -2, 0, 0, 2}},
    {"radau_ia", SystemKind::kMechanical3, 'u', {1, 2, 3, 4, 5}},
    {"radau_ia", SystemKind::kMechanical3, 'v', {1, 1, 2, 3, 4}},
    {"radau_ia", SystemKind::kMechanical3, 'z', {1, 0, 1, 2, 3}},
    {"radau_iia", SystemKind::kMechanical3, 'u', {1, 3, 5, 7, 9}},
    {"radau_iia", SystemKind::kMechanical3, 'v', {1, 2, 3, 4, 5}},
    {"radau_iia", SystemKind::kMechanical3, 'z', {1, 1, 2, 3, 4}},
    {"lobatto_iiia", SystemKind::kMechanical3, 'u', {2, 2, 6, 6}},
    {"lobatto_iiia", SystemKind::kMechanical3, 'v', {2, 2, 4, 4}},
    {"lobatto_iiia", SystemKind::kMechanical3, 'z', {0, 0, 2, 2}},
    {"lobatto_iiic", SystemKind::kMechanical3, 'u', {2, 4, 6, 8}},
    {"lobatto_iiic", SystemKind::kMechanical3, 'v', {1, 2, 3, 4}},
    {"lobatto_iiic", SystemKind::kMechanical3, 'z', {0, 1, 2, 3}},
    {"gauss", SystemKind::kMechanical2, 'u', {2, 4, 6, 8, 10}},
    {"gauss", SystemKind::kMechanical2, 'v', {2, 2, 4, 4, 6}},
    {"gauss", SystemKind::kMechanical2, 'z', {0, 0, 2, 2, 4}},
    {"gauss", SystemKind::kProjected, 'v', {2, 4, 6, 8, 10}},
    {"radau_ia", SystemKind::kMechanical2, 'u', {1, 3, 5, 7, 9}},
    {"radau_ia", SystemKind::kMechanical2, 'v', {1, 2, 3, 4, 5}},
    {"radau_ia", SystemKind::kMechanical2, 'z', {1, 1, 2, 3, 4}},
    {"radau_ia", SystemKind::kProjected, 'v', {1, 3, 5, 7, 9}},
    {"radau_iia", SystemKind::kMechanical2, 'u', {1, 3, 5, 7, 9}},
    {"radau_iia", SystemKind::kMechanical2, 'v', {1, 3, 5, 7, 9}},
    {"radau_iia", SystemKind::kMechanical2, 'z', {1, 2, 3, 4, 5}},
    {"lobatto_iiia", SystemKind::kMechanical2, 'u', {2, 4, 6, 8}},
    {"lobatto_iiia", SystemKind::kMechanical2, 'v', {2, 4, 6, 8}},
    {"lobatto_iiia", SystemKind::kMechanical2, 'z', {2, 2, 4, 4}},
    {"lobatto_iiic", SystemKind::kMechanical2, 'u', {2, 4, 6, 8}},
    {"lobatto_iiic", SystemKind::kMechanical2, 'v', {2, 4, 6, 8}},
    {"lobatto_iiic", SystemKind::kMechanical2, 'z', {1, 2, 3, 4}},
    {"gauss", SystemKind::kGgl, 'u', {2, 2, 4, 4, 6}},
    {"gauss", SystemKind::kGgl, 'v', {2, 2, 4, 4, 6}},
    {"gauss", SystemKind::kGgl, 'z', {0, 0, 2, 2, 4}},
    {"radau_ia", SystemKind::kGgl, 'u', {1, 2, 3, 4, 5}},
    {"radau_ia", SystemKind::kGgl, 'v', {1, 2, 3, 4, 5}},
    {"radau_ia", SystemKind::kGgl, 'z', {1, 1, 2, 3, 4}},
    {"radau_iia", SystemKind::kGgl, 'u', {1, 3, 5, 7, 9}},
    {"lobatto_iiia", SystemKind::kGgl, 'v', {2, 4, 6, 8}},
    {"lobatto_iiic", SystemKind::kGgl, 'z', {1, 2, 3, 4}},
    {"gauss", SystemKind::kStiffFixedZ, 'x', {2, 2, 4, 4, 6}},
    {"gauss", SystemKind::kStiffPowerOfZ, 'x', {0, 0, 0, 0, 0}},
    {"gauss", SystemKind::kStiffFixedLambda, 'x', {2, 2, 4, 4, 6}},
    {"radau_ia", SystemKind::kStiffFixedZ, 'x', {1, 2, 3, 4, 5}},
    {"radau_ia", SystemKind::kStiffFixedLambda, 'x', {1, 2, 3, 4, 5}},
    {"radau_iia", SystemKind::kStiffFixedZ, 'x', {2, 3, 4, 5, 6}},
    {"radau_iia", SystemKind::kStiffPowerOfZ, 'x', {-1, -1, -1, -1, -1}},
    {"radau_iia", SystemKind::kStiffFixedLambda, 'x', {1, 2, 3, 4, 5}},
    {"lobatto_iiia", SystemKind::kStiffFixedZ, 'x', {3, 3, 5, 5}},
    {"lobatto_iiia", SystemKind::kStiffPowerOfZ, 'x', {-1, -1, -1, -1}},
    {"lobatto_iiia", SystemKind::kStiffFixedLambda, 'x', {2, 2, 4, 4}},
    {"lobatto_iiib", SystemKind::kStiffFixedZ, 'x', {1, 1, 3, 3}},
    {"lobatto_iiib", SystemKind::kStiffPowerOfZ, 'x', {1, 1, 1, 1}},
    {"lobatto_iiib", SystemKind::kStiffFixedLambda, 'x', {2, 2, 4, 4}},
    {"lobatto_iiic", SystemKind::kStiffFixedZ, 'x', {2, 3, 4, 5}},
    {"lobatto_iiic", SystemKind::kStiffPowerOfZ, 'x', {-1, -1, -1, -1}},
    {"lobatto_iiic", SystemKind::kStiffFixedLambda, 'x', {1, 2, 3, 4}},
    {"lobatto_iiid", SystemKind::kStiffFixedZ, 'x', {1, 3, 3, 5}},
    {"lobatto_iiid", SystemKind::kStiffPowerOfZ, 'x', {-1, -1, -1, -1}},
    {"lobatto_iiid", SystemKind::kStiffFixedLambda, 'x', {0, 2, 2, 4}},
};

TEST(Theory, AgreesWithTheTables) {
  for (const auto& [family, kind, component, orders] : kTable) {
    Index s = 6 - static_cast<Index>(orders.size());
    for (const double order : orders) {
      const auto theory = theoreticalOrder(family, s, kind, component);
      ASSERT_TRUE(theory) << family << " s = " << s << " " << component;
      EXPECT_EQ(theory->order, order) << family << " s = " << s << " " << component;
      EXPECT_NE(theory->source, "extrapolated") << family << " s = " << s;
      ++s;
    }
  }
}

TEST(Theory, OrdersOfManyStagesAreMarkedUnlessTheyAreTheorems) {
  EXPECT_EQ(theoreticalOrder("gauss", 20, SystemKind::kOde, 'x')->order, 40);
  EXPECT_EQ(theoreticalOrder("gauss", 20, SystemKind::kOde, 'x')->source, "theorem");
  EXPECT_EQ(theoreticalOrder("gauss", 6, SystemKind::kMechanical3, 'z')->source, "extrapolated");
}

TEST(Theory, IsEmptyWhereNothingIsKnown) {
  EXPECT_FALSE(theoreticalOrder("my_method", 3, SystemKind::kOde, 'x'));
  EXPECT_FALSE(theoreticalOrder("lobatto_iiib", 3, SystemKind::kMechanical2, 'u'));
  EXPECT_FALSE(theoreticalOrder("lobatto_iiics", 3, SystemKind::kStiffFixedZ, 'x'));
}

}  // namespace
}  // namespace irk
