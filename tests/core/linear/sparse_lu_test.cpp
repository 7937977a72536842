// Sparse LU factors against dense ones, with pivots off the diagonal and with changing pivots; systems solved
// together against systems solved one by one.
#include "core/linear/interleaved_lu.h"

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

// The matrix [[K, G^T], [G, 0]]: a band K of 12 and three constraints, with zeros on part of the diagonal and rows
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

// A matrix with the pattern of a dense matrix's nonzeros and its values.
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
  Outcome factorize(const Mat<T>& A, const SparsePivots* others = nullptr, bool rather = false) {
    std::size_t k = 0;
    for (Index j = 0; j < A.cols(); ++j) {
      for (; k < static_cast<std::size_t>(analysis_->column_start[static_cast<std::size_t>(j) + 1]); ++k) {
        lu->values()[k] = A(analysis_->row[k], j);
      }
    }
    return lu->factorize(others, rather);
  }
  const std::shared_ptr<const SparseAnalysis>& analysis() const { return analysis_; }
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
  // Nearby values keep the pivots. Other values either need new pivots or can use the old ones; both solve the
  // system.
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

// KLU's own rule: pivots of another matrix are used only if no entry of L exceeds 1 / 0.001.
TEST(SparseLu, TakesOthersPivotsOnlyWhereTheyServe) {
  Mat<double> A(2, 2), like(2, 2), unlike(2, 2), beyond(2, 2);
  A << 1, 0.5, 0.5, 2;
  like << 1, 4, 400, 2;
  unlike << 1e-14, 1, 1, 1e-14;
  beyond << 1, 3000, 3000, 2;  // L has 1500 or 3000
  Filled<double> first(A), second(A), third(A), fourth(A);
  ASSERT_EQ(first.factorize(A), Outcome::kSuccess);
  ASSERT_EQ(second.factorize(like, &first.lu->pivots()), Outcome::kSuccess);
  EXPECT_EQ(second.lu->pivotings(), 0);
  EXPECT_TRUE(second.lu->pivots() == first.lu->pivots());
  expectSolves(*second.lu, like, 1e-12);
  ASSERT_EQ(third.factorize(unlike, &first.lu->pivots()), Outcome::kSuccess);
  EXPECT_EQ(third.lu->pivotings(), 1);
  EXPECT_FALSE(third.lu->pivots() == first.lu->pivots());
  expectSolves(*third.lu, unlike, 1e-14);
  ASSERT_EQ(fourth.factorize(beyond, &first.lu->pivots()), Outcome::kSuccess);
  EXPECT_EQ(fourth.lu->pivotings(), 1);
  // If its own pivots serve, the other ones are used only on request.
  ASSERT_EQ(third.factorize(like, &first.lu->pivots()), Outcome::kSuccess);
  EXPECT_FALSE(third.lu->pivots() == first.lu->pivots());
  ASSERT_EQ(third.factorize(like, &first.lu->pivots(), true), Outcome::kSuccess);
  EXPECT_TRUE(third.lu->pivots() == first.lu->pivots());
  expectSolves(*third.lu, like, 1e-12);
}

// Real and complex matrices of one pattern with the pivots of the first one, in more than one group of lanes.
TEST(InterleavedLu, AgreesWithSolvesOneByOne) {
  using Complex = std::complex<double>;
  const Mat<double> A = saddle<double>(1);
  const Index n = A.rows();
  for (const int pairs : {1, 4, 12}) {
    SCOPED_TRACE(pairs);
    std::vector<SparseLu<double>> real;
    std::vector<SparseLu<Complex>> complex;
    Filled<double> first(A);
    ASSERT_EQ(first.factorize(A), Outcome::kSuccess);
    const auto near = [&](int i) { return Mat<double>((1 + 0.1 * i) * A); };
    real.push_back(std::move(*first.lu));
    for (int i = 0; i < pairs; ++i) {
      Filled<Complex> other(A.cast<Complex>());
      const Mat<Complex> B = near(i).cast<Complex>() + Complex(0, 0.3) * near(i + 1).cast<Complex>();
      ASSERT_EQ(other.factorize(B, &real.front().pivots()), Outcome::kSuccess);
      ASSERT_EQ(other.lu->pivotings(), 0);
      complex.push_back(std::move(*other.lu));
    }
    InterleavedLu together(*first.analysis(), real.size() + complex.size());
    ASSERT_TRUE(together.assign(real, complex));
    Mat<double> Y = Mat<double>::Random(n, 1 + 2 * pairs), expected = Y;
    constexpr double kSigma = 0.7;
    std::vector<InterleavedLu::Lane> lanes{{Y.data(), nullptr, 1, 1}};
    real.front().solve(expected.data());
    for (int i = 0; i < pairs; ++i) {
      const Index re = 1 + 2 * i;
      lanes.push_back({Y.col(re).data(), Y.col(re + 1).data(), kSigma, 1 / kSigma});
      Vec<Complex> y = expected.col(re) + Complex(0, kSigma) * expected.col(re + 1);
      complex[static_cast<std::size_t>(i)].solve(y.data());
      expected.col(re) = y.real();
      expected.col(re + 1) = y.imag() / kSigma;
    }
    together.solve(lanes);
    for (Index j = 0; j < Y.cols(); ++j) {
      EXPECT_LT((Y.col(j) - expected.col(j)).norm(), 1e-12 * expected.col(j).norm()) << j;
    }
  }
}

TEST(InterleavedLu, RefusesDifferentPivotsAndFollowsTheirChanges) {
  Mat<double> A(2, 2), swapped(2, 2);
  A << 1, 0.5, 0.5, 2;
  swapped << 1e-14, 1, 1, 1e-14;
  Filled<double> first(A), second(A);
  ASSERT_EQ(first.factorize(A), Outcome::kSuccess);
  ASSERT_EQ(second.factorize(swapped), Outcome::kSuccess);
  std::vector<SparseLu<double>> both;
  both.push_back(std::move(*first.lu));
  both.push_back(std::move(*second.lu));
  InterleavedLu together(*first.analysis(), 2);
  EXPECT_FALSE(together.assign(both, {}));
  EXPECT_FALSE(together.assign(both, {})) << "nothing has changed";
  // Both use the pivots of the second matrix.
  std::copy(swapped.data(), swapped.data() + 4, both[0].values());
  ASSERT_EQ(both[0].factorize(&both[1].pivots()), Outcome::kSuccess);
  EXPECT_EQ(both[0].pivotings(), 1);
  ASSERT_TRUE(together.assign(both, {}));
  Mat<double> Y = Mat<double>::Random(2, 2);
  const Mat<double> b = Y;
  const std::vector<InterleavedLu::Lane> lanes{{Y.col(0).data(), nullptr, 1, 1}, {Y.col(1).data(), nullptr, 1, 1}};
  together.solve(lanes);
  EXPECT_LT((swapped * Y - b).norm(), 1e-14);
}

TEST(SparseLu, OneUnknown) {
  const Mat<double> A = Mat<double>::Constant(1, 1, -4.0);
  Filled<double> sparse(A);
  ASSERT_EQ(sparse.factorize(A), Outcome::kSuccess);
  expectSolves(*sparse.lu, A, 1e-15);
}

}  // namespace
}  // namespace irk::test
