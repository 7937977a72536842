// The LU of complex matrices in planes against Eigen's LU with complete pivoting and against plain loops.
#include "core/linear/split_lu.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>
#include <random>

#include "core/linear/dense_lu.h"

namespace irk::test {
namespace {

using Complex = std::complex<double>;

// Around multiples of the group of 8 rows, of the panels and of the halves.
constexpr Index kSizes[] = {1, 2, 7, 8, 9, 15, 16, 17, 31, 48, 49, 64, 100, 129, 203};

struct Random {
  std::mt19937 bits{7};
  std::normal_distribution<double> normal;

  Mat<Complex> matrix(Index n) {
    Mat<Complex> A(n, n);
    for (Index j = 0; j < n; ++j) {
      for (Index i = 0; i < n; ++i) A(i, j) = {normal(bits), normal(bits)};
    }
    return A;
  }
};

void fill(SplitLu& lu, const Mat<Complex>& A) {
  for (Index j = 0; j < A.cols(); ++j) {
    VecView<double>(lu.re(j), A.rows()) = A.col(j).real();
    VecView<double>(lu.im(j), A.rows()) = A.col(j).imag();
  }
}

void fill(DenseLu<Complex>& lu, const Mat<Complex>& A) {
  for (Index j = 0; j < A.cols(); ++j) lu.fillColumn(j, [&](Index i) { return A(i, j); });
}

// Backward error: the residual in units of what rounding x alone would leave.
double residual(const Mat<Complex>& A, const Vec<Complex>& x, const Vec<Complex>& b) {
  return (A * x - b).norm() / (A.norm() * x.norm() + b.norm());
}

TEST(SplitLu, SolvesAsLuWithCompletePivoting) {
  Random random;
  for (const Index n : kSizes) {
    SCOPED_TRACE(n);
    Mat<Complex> A = random.matrix(n);
    if (n > 2) A.diagonal().setZero();  // no factorization without exchanges of rows
    SplitLu lu(n);
    fill(lu, A);
    ASSERT_EQ(lu.factorize(), Outcome::kSuccess);
    const Eigen::FullPivLU<Mat<Complex>> complete(A);
    for (int k = 0; k < 2; ++k) {  // factors serve several right-hand sides
      const Vec<Complex> b = random.matrix(n).col(0);
      Vec<Complex> x = b;
      lu.solve(x.data());
      EXPECT_LT(residual(A, x, b), 1e-14 * std::sqrt(static_cast<double>(n)));
      const Vec<Complex> exact = complete.solve(b);
      EXPECT_LT((x - exact).norm(), 1e-10 * exact.norm());
    }
  }
}

// DenseLu's plain loops, which choose the same pivots.
TEST(SplitLu, EqualsPlainLoops) {
  Random random;
  for (const Index n : {3, 8, 20, 28}) {
    const Mat<Complex> A = random.matrix(n);
    Vec<Complex> x = random.matrix(n).col(0), y = x;
    SplitLu lu(n);
    fill(lu, A);
    DenseLu<Complex> plain(n);
    fill(plain, A);
    ASSERT_EQ(lu.factorize(), plain.factorize());
    lu.solve(x.data());
    plain.solve(y.data());
    EXPECT_LT((x - y).norm(), 1e-12 * y.norm()) << n;
  }
}

TEST(SplitLu, IsUsedForLargeMatrices) {
  Random random;
  const Mat<Complex> A = random.matrix(60);
  Vec<Complex> x = random.matrix(60).col(0);
  const Vec<Complex> b = x;
  DenseLu<Complex> lu(60);
  fill(lu, A);
  ASSERT_EQ(lu.factorize(), Outcome::kSuccess);
  lu.solve(x.data());
  EXPECT_LT(residual(A, x, b), 1e-13);
}

TEST(SplitLu, ReportsZeroPivotsAndNumbersThatAreNotFinite) {
  Random random;
  for (const Index n : {1, 8, 9, 30, 129}) {
    SCOPED_TRACE(n);
    SplitLu lu(n);
    const Mat<Complex> A = random.matrix(n);
    for (const Index j : {Index(0), n / 2, n - 1}) {
      Mat<Complex> singular = A;
      singular.col(j).setZero();
      fill(lu, singular);
      EXPECT_EQ(lu.factorize(), Outcome::kSingular) << j;
      for (const Index i : {Index(0), n / 2, n - 1}) {
        for (const Complex wrong : {Complex(std::numeric_limits<double>::infinity(), 0),
                                    Complex(0, std::numeric_limits<double>::quiet_NaN())}) {
          Mat<Complex> broken = A;
          broken(i, j) = wrong;
          fill(lu, broken);
          EXPECT_EQ(lu.factorize(), Outcome::kNotFinite) << i << ' ' << j;
        }
      }
    }
    // The next factorization does not depend on the failed one.
    fill(lu, A);
    ASSERT_EQ(lu.factorize(), Outcome::kSuccess);
    const Vec<Complex> b = random.matrix(n).col(0);
    Vec<Complex> x = b;
    lu.solve(x.data());
    EXPECT_LT(residual(A, x, b), 1e-13);
  }
}

}  // namespace
}  // namespace irk::test
