// The sparse factors against dense ones, where pivots are off the diagonal and where they have to change.
#include "core/sparse_lu.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <random>

#include "tests/core/support.h"

namespace irk::test {
namespace {

template <class T>
T entry(std::minstd_rand& random);
template <>
double entry<double>(std::minstd_rand& random) {
  return std::uniform_real_distribution<double>(-1, 1)(random);
}
template <>
std::complex<double> entry<std::complex<double>>(std::minstd_rand& random) {
  const double re = entry<double>(random);
  return {re, entry<double>(random)};
}

// [[K, G^T], [G, 0]]: a band K of 12 and three constraints, zeros on a part of the diagonal; rows
// scaled from 1e-6 to 1e6.
template <class T>
Mat<T> saddle(unsigned seed) {
  constexpr Index m = 12, n = 15;
  std::minstd_rand random(seed);
  Mat<T> A = Mat<T>::Zero(n, n);
  for (Index i = 0; i < m; ++i) {
    for (Index j = std::max<Index>(0, i - 1); j < std::min(m, i + 2); ++j) A(i, j) = entry<T>(random);
  }
  for (Index c = 0; c < 3; ++c) {
    for (Index k = 0; k < 2; ++k) A(m + c, 4 * c + k) = A(4 * c + k, m + c) = entry<T>(random);
  }
  for (Index i = 0; i < n; ++i) A.row(i) *= std::pow(10.0, static_cast<double>(i % 5) * 3 - 6);
  return A;
}

// A matrix whose values are set from dense ones, in the pattern of those that are not zero.
template <class T>
class Filled {
 public:
  explicit Filled(const Mat<T>& A) {
    std::vector<int> start{0}, row;
    for (Index j = 0; j < A.cols(); ++j) {
      for (Index i = 0; i < A.rows(); ++i) {
        if (A(i, j) != T(0)) row.push_back(static_cast<int>(i));
      }
      start.push_back(static_cast<int>(row.size()));
    }
    analysis_ = std::make_shared<const SparseAnalysis>(start, row);
    lu = std::make_unique<SparseLu<T>>(analysis_);
  }
  Outcome factorize(const Mat<T>& A) {
    std::size_t k = 0;
    for (Index j = 0; j < A.cols(); ++j) {
      for (; k < static_cast<std::size_t>(analysis_->column_start[static_cast<std::size_t>(j) + 1]); ++k) {
        lu->values()[k] = A(analysis_->row[k], j);
      }
    }
    return lu->factorize();
  }
  std::unique_ptr<SparseLu<T>> lu;

 private:
  std::shared_ptr<const SparseAnalysis> analysis_;
};

template <class T>
void expectSolves(SparseLu<T>& lu, const Mat<T>& A, double tolerance) {
  const Vec<T> x = Vec<T>::Random(A.rows());
  Vec<T> b = A * x;
  lu.solve(b.data());
  EXPECT_LT((b - x).norm(), tolerance * x.norm());
}

template <class T>
void solvesAndRenews() {
  const Mat<T> A = saddle<T>(1);
  Filled<T> sparse(A);
  ASSERT_EQ(sparse.factorize(A), Outcome::kSuccess);
  EXPECT_EQ(sparse.lu->pivotings(), 1);
  expectSolves(*sparse.lu, A, 1e-9);
  // Nearby values keep the pivots; other ones ask for new pivots or do with the old, and solve.
  const Mat<T> near = 1.01 * A;
  ASSERT_EQ(sparse.factorize(near), Outcome::kSuccess);
  EXPECT_EQ(sparse.lu->pivotings(), 1);
  expectSolves(*sparse.lu, near, 1e-9);
  for (unsigned seed = 2; seed < 12; ++seed) {
    const Mat<T> other = saddle<T>(seed);
    ASSERT_EQ(sparse.factorize(other), Outcome::kSuccess);
    expectSolves(*sparse.lu, other, 1e-7);
  }
}

TEST(SparseLu, SolvesAndRenewsReal) { solvesAndRenews<double>(); }
TEST(SparseLu, SolvesAndRenewsComplex) { solvesAndRenews<std::complex<double>>(); }

TEST(SparseLu, ChoosesNewPivotsWhereTheOldOnesVanish) {
  Mat<double> A(2, 2);
  A << 1, 0.5, 0.5, 2;
  Filled<double> sparse(A);
  ASSERT_EQ(sparse.factorize(A), Outcome::kSuccess);
  A << 1e-14, 1, 1, 1e-14;
  ASSERT_EQ(sparse.factorize(A), Outcome::kSuccess);
  EXPECT_EQ(sparse.lu->pivotings(), 2);
  expectSolves(*sparse.lu, A, 1e-14);
}

TEST(SparseLu, SaysSingularAndNotFiniteAndRecovers) {
  Mat<double> A(2, 2), singular(2, 2);
  A << 1, 2, 3, 4;
  singular << 1, 2, 2, 4;
  Filled<double> sparse(A);
  EXPECT_EQ(sparse.factorize(singular), Outcome::kSingular);
  Mat<double> bad = A;
  bad(1, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(sparse.factorize(bad), Outcome::kNotFinite);
  ASSERT_EQ(sparse.factorize(A), Outcome::kSuccess);
  expectSolves(*sparse.lu, A, 1e-13);
}

TEST(SparseLu, OneUnknown) {
  const Mat<double> A = Mat<double>::Constant(1, 1, -4.0);
  Filled<double> sparse(A);
  ASSERT_EQ(sparse.factorize(A), Outcome::kSuccess);
  expectSolves(*sparse.lu, A, 1e-15);
}

}  // namespace
}  // namespace irk::test
