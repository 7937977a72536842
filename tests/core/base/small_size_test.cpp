// Unrolled loops against general products.
#include <gtest/gtest.h>

#include <complex>
#include <limits>

#include "core/base/small_product.h"
#include "core/linear/small_inverse.h"
#include "tests/core/support.h"

namespace irk::test {
namespace {

TEST(SmallSize, PassesTheNumberAsAConstantUpToALimit) {
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
      const Mat<double> square = Mat<double>::Random(inner, inner);
      Mat<double> all = Mat<double>::Constant(rows, inner, 7.0);
      smallProduct<double>(A, square, all);
      EXPECT_LT((all - A * square).norm(), 1e-14 * static_cast<double>(rows * inner * inner));
    }
  }
}

// Every size that is made in place and some that are not; the rows lie between others, which stay as they are. The
// compiler is free to contract other products and sums in each.
TEST(SmallSize, InlinedProductsAreTheGeneralOne) {
  const Mat<double> first = Mat<double>::Random(6, 5);
  const auto start = [&](Index i, Index j) { return first(i, j); };
  for (Index rows = 0; rows <= 6; ++rows) {
    for (Index inner = 1; inner <= 5; ++inner) {
      for (const Index columns : {Index(1), Index(2), inner}) {
        const Mat<double> A = Mat<double>::Random(rows + 2, inner), B = Mat<double>::Random(inner, columns);
        Mat<double> expected = Mat<double>::Constant(rows + 3, columns, 7.0), all = expected;
        smallProduct(A.data() + 1, rows + 2, rows, B, expected.data() + 1, rows + 3, start);
        inlinedProduct(A.data() + 1, rows + 2, rows, B, all.data() + 1, rows + 3, start);
        EXPECT_LT((all - expected).norm(), 1e-14) << rows << " " << inner << " " << columns;
        const Vec<double> b = B.col(0);
        Vec<double> one = Vec<double>::Constant(rows + 3, 7.0), in_place = one;
        smallProduct(A.data() + 1, rows + 2, rows, b, one.data() + 1, rows + 3);
        inlinedProduct(A.data() + 1, rows + 2, rows, b, in_place.data() + 1, rows + 3);
        EXPECT_LT((in_place - one).norm(), 1e-14) << rows << " " << inner;
      }
    }
  }
}

TEST(SmallSize, CopiesOfEverySize) {
  for (Index n = 0; n <= 12; ++n) {
    const Vec<double> from = Vec<double>::Random(n);
    Vec<double> to = Vec<double>::Constant(n + 1, 7.0);
    copyFew(from.data(), n, to.data());
    EXPECT_EQ(to.head(n), from);
    EXPECT_EQ(to[n], 7);
  }
}

// Covers the unrolled and the general loops; the rows are ordered so that pivoting is needed.
TEST(SmallInverse, RealAndComplexAgainstEigen) {
  for (Index n = 1; n <= kSmallInverse; ++n) {
    Mat<double> re = Mat<double>::Random(n, n), im = Mat<double>::Random(n, n);
    re(0, 0) = im(0, 0) = 0;
    if (n == 1) re(0, 0) = -3;
    Mat<std::complex<double>> both(n, n);
    both.real() = re;
    both.imag() = im;
    for (const bool unrolled : {false, true}) {
      Mat<double> real = re, split(n, 2 * n);
      split << re, im;
      const auto invertBoth = [&](auto size) {
        EXPECT_EQ(invert<1>(real.data(), size), Outcome::kSuccess) << n;
        EXPECT_EQ(invert<2>(split.data(), size), Outcome::kSuccess) << n;
      };
      unrolled ? withSize<8>(n, invertBoth) : invertBoth(n);
      const Mat<std::complex<double>> inverse = both.inverse();
      EXPECT_LT((real - re.inverse()).norm(), 1e-11 * re.inverse().norm()) << n;
      EXPECT_LT((split.leftCols(n) - inverse.real()).norm(), 1e-11 * inverse.norm()) << n;
      EXPECT_LT((split.rightCols(n) - inverse.imag()).norm(), 1e-11 * inverse.norm()) << n;
    }
  }
}

TEST(SmallInverse, ReportsSingularMatrices) {
  Mat<double> singular = Mat<double>::Ones(3, 3);
  EXPECT_EQ(invert<1>(singular.data(), Index(3)), Outcome::kSingular);
  for (Index at = 0; at < 9; ++at) {
    Mat<double> bad = Mat<double>::Random(3, 3);
    bad.data()[at] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(invert<1>(bad.data(), Index(3)), Outcome::kNotFinite) << at;
  }
}

TEST(SmallInverse, ProductsOfEverySize) {
  for (Index m = 1; m <= 2 * kSmallInverse; ++m) {
    const Mat<double> A = Mat<double>::Random(m, m);
    Vec<double> y = Vec<double>::Random(m);
    const Vec<double> expected = A * y;
    multiplySmall(A.data(), y.data(), m);
    EXPECT_LT((y - expected).norm(), 1e-14 * static_cast<double>(m * m)) << m;
  }
}

}  // namespace
}  // namespace irk::test
