// Unrolled loops against general products.
#include <gtest/gtest.h>

#include "core/small_product.h"
#include "tests/core/support.h"

namespace irk::test {
namespace {

TEST(SmallSize, TheFunctionSeesTheNumberAsConstantOrNot) {
  for (Index n = 0; n <= 12; ++n) {
    const bool constant = withSize<4>(n, [&](auto size) {
      EXPECT_EQ(Index(size), n);
      return !std::is_same_v<decltype(size), Index>;
    });
    EXPECT_EQ(constant, n >= 1 && n <= 4) << n;
  }
}

TEST(SmallSize, ProductsOfEverySize) {
  for (Index rows = 1; rows <= 13; ++rows) {
    for (Index inner = 1; inner <= 11; ++inner) {
      const Mat<double> A = Mat<double>::Random(rows, inner), B = Mat<double>::Random(inner, 3);
      Mat<double> out = Mat<double>::Constant(rows, 3, 7.0);
      smallProduct<double>(A, B, out);
      EXPECT_LT((out - A * B).norm(), 1e-14 * static_cast<double>(rows * inner));
      Vec<double> one = Vec<double>::Constant(rows, 7.0);
      smallProduct<double>(A, B.col(1), one);
      EXPECT_LT((one - A * B.col(1)).norm(), 1e-14 * static_cast<double>(rows * inner));
    }
  }
}

}  // namespace
}  // namespace irk::test
