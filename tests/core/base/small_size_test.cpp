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

TEST(SmallSize, ProductsBeginWithTheirStarts) {
  for (Index rows = 1; rows <= 21; ++rows) {
    const Mat<double> A = Mat<double>::Random(rows, 3), B = Mat<double>::Random(3, 2), product = A * B;
    const Vec<double> y = Vec<double>::Random(rows), slope = Vec<double>::Random(rows),
                      factors = Vec<double>::Random(2);
    Mat<double> out = Mat<double>::Constant(rows, 2, 7.0);
    smallProduct(A.data(), rows, rows, B, out.data(), rows, FromColumn<double>{y.data()});
    EXPECT_LT((out - (product.colwise() + y)).norm(), 1e-14) << rows;
    smallProduct(A.data(), rows, rows, B, out.data(), rows, FromLine<double>{y.data(), slope.data(), factors.data()});
    EXPECT_LT((out - ((product + slope * factors.transpose()).colwise() + y)).norm(), 1e-14) << rows;
  }
}

// Every size that is made in place and some that are not; the rows lie between others, which stay as they are. The
// compiler is free to contract other products and sums in each.
TEST(SmallSize, InlinedProductsAreTheGeneralOne) {
  const Vec<double> y = Vec<double>::Random(6), slope = Vec<double>::Random(6), factors = Vec<double>::Random(5);
  const FromLine<double> start{y.data(), slope.data(), factors.data()};
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

// Calls f(n) with n = 1 .. kSmallInverse as constants.
template <class F>
void forEachSmallSize(const F& f) {
  for (Index n = 1; n <= kSmallInverse; ++n) {
    withSize<kSmallInverse>(n, [&](auto size) {
      if constexpr (!std::is_same_v<decltype(size), Index>) f(size);
    });
  }
}

template <int Parts, Index N>
Outcome invertIn(Mat<double>& numbers, std::integral_constant<Index, N> n) {
  SmallMatrix data;
  data.fill(std::numeric_limits<double>::quiet_NaN());  // behind the matrix
  std::copy_n(numbers.data(), numbers.size(), data.data());
  const Outcome outcome = invert<Parts>(data, n);
  std::copy_n(data.data(), numbers.size(), numbers.data());
  return outcome;
}

// The rows are ordered so that pivoting is needed.
TEST(SmallInverse, RealAndComplexAgainstEigen) {
  forEachSmallSize([](auto size) {
    constexpr Index n = decltype(size)::value;
    for (int round = 0; round < 20; ++round) {
      Mat<double> re = Mat<double>::Random(n, n), im = Mat<double>::Random(n, n);
      if (n > 1 && round % 2 == 0) re(0, 0) = im(0, 0) = 0;
      if (round == 3) im.setZero();  // both branches of the complex division
      if (round == 5) im *= 1e-3;
      Mat<std::complex<double>> both(n, n);
      both.real() = re;
      both.imag() = im;
      Mat<double> real = re, split(n, 2 * n);
      split << re, im;
      EXPECT_EQ(invertIn<1>(real, size), Outcome::kSuccess) << n;
      EXPECT_EQ(invertIn<2>(split, size), Outcome::kSuccess) << n;
      const Mat<std::complex<double>> inverse = both.inverse();
      EXPECT_LT((real - re.inverse()).norm(), 1e-11 * re.inverse().norm()) << n;
      EXPECT_LT((split.leftCols(n) - inverse.real()).norm(), 1e-11 * inverse.norm()) << n;
      EXPECT_LT((split.rightCols(n) - inverse.imag()).norm(), 1e-11 * inverse.norm()) << n;
    }
  });
}

// A determinant may be far outside of the numbers of the matrix, or not be representable.
TEST(SmallInverse, IsRightForAnyScale) {
  forEachSmallSize([](auto size) {
    constexpr Index n = decltype(size)::value;
    Mat<double> split = Mat<double>::Random(n, 2 * n);
    for (Index i = 0; i < n; ++i) split(i, i) += 3;
    Mat<double> real = split.leftCols(n);
    Mat<double> inverse = real, split_inverse = split;
    ASSERT_EQ(invertIn<1>(inverse, size), Outcome::kSuccess);
    ASSERT_EQ(invertIn<2>(split_inverse, size), Outcome::kSuccess);
    for (const double scale : {1e-250, 1e-150, 1e-80, 1e-20, 1e20, 1e80, 1e150, 1e250}) {
      Mat<double> scaled = scale * real, split_scaled = scale * split;
      EXPECT_EQ(invertIn<1>(scaled, size), Outcome::kSuccess) << n << " " << scale;
      EXPECT_EQ(invertIn<2>(split_scaled, size), Outcome::kSuccess) << n << " " << scale;
      EXPECT_LT((scale * scaled - inverse).norm(), 1e-13 * inverse.norm()) << n << " " << scale;
      EXPECT_LT((scale * split_scaled - split_inverse).norm(), 1e-13 * split_inverse.norm()) << n << " " << scale;
    }
  });
}

TEST(SmallInverse, ReportsSingularMatrices) {
  forEachSmallSize([](auto size) {
    constexpr Index n = decltype(size)::value;
    Mat<double> singular = n == 1 ? Mat<double>::Zero(n, n) : Mat<double>::Ones(n, n);
    Mat<double> split(n, 2 * n);
    split << singular, 2 * singular;
    // 0.3 * 0.3 has round-off, which a fused multiplication and subtraction would show as a determinant.
    Mat<double> rounded = 0.3 * singular;
    EXPECT_EQ(invertIn<1>(singular, size), Outcome::kSingular) << n;
    EXPECT_EQ(invertIn<2>(split, size), Outcome::kSingular) << n;
    EXPECT_EQ(invertIn<1>(rounded, size), Outcome::kSingular) << n;
    for (const double value : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      for (Index at = 0; at < 2 * n * n; ++at) {
        Mat<double> bad = Mat<double>::Random(n, 2 * n);
        bad.data()[at] = value;
        Mat<double> real = bad.leftCols(n);
        const bool in_real = at < n * n;
        EXPECT_EQ(invertIn<1>(real, size) == Outcome::kNotFinite, in_real) << n << " " << at;
        EXPECT_EQ(invertIn<2>(bad, size), Outcome::kNotFinite) << n << " " << at;
      }
    }
  });
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
