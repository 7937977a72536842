// Sparse LU factors against dense ones, with pivots off the diagonal and with changing pivots; systems solved
// together against systems solved one by one.
#include "core/linear/interleaved_lu.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <limits>
#include <random>
#include <string>

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

TEST(SparseLu, ReportsSingularAndNotFiniteAndRecovers) {
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
TEST(SparseLu, UsesGivenPivotsOnlyWhereTheyAreStable) {
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

// D0, D1 and D2 of one pattern, with rows scaled by S.
struct Pencil {
  Mat<double> D0, D1, D2;
  Vec<double> S;
  Filled<double> pattern;
  Vec<double> d0, d1, d2;

  Pencil(const Mat<double>& A0, const Mat<double>& A1, const Mat<double>& A2)
      : D0(A0), D1(A1), D2(A2), S(A0.rows()), pattern(A0), d0(entries(A0)), d1(entries(A1)), d2(entries(A2)) {
    for (Index i = 0; i < S.size(); ++i) S[i] = 0.5 + static_cast<double>(i % 3);
  }
  InterleavedLu::Pencil view() const { return {d0.data(), d1.data(), d2.data(), S.data()}; }
  Mat<std::complex<double>> at(std::complex<double> m) const {
    return S.asDiagonal() * (D0.cast<std::complex<double>>() + m * D1 + m * m * D2);
  }

 private:
  Vec<double> entries(const Mat<double>& A) const {
    const SparseAnalysis& analysis = *pattern.analysis();
    Vec<double> values(static_cast<Index>(analysis.row.size()));
    for (Index j = 0, k = 0; j < A.cols(); ++j) {
      for (; k < analysis.column_start[static_cast<std::size_t>(j) + 1]; ++k) {
        values[k] = A(analysis.row[static_cast<std::size_t>(k)], j);
      }
    }
    return values;
  }
};

// All lanes against SparseLu with the pivots of the first matrix, which is real or not.
void expectTogether(InterleavedLu& together, const Pencil& pencil, const std::vector<std::complex<double>>& m) {
  using Complex = std::complex<double>;
  const Index n = pencil.D0.rows();
  ASSERT_TRUE(together.factorize(pencil.view(), m));
  const auto columns = static_cast<Index>(m.size());
  Mat<double> re = Mat<double>::Random(n, columns), im = Mat<double>::Random(n, columns);
  const Mat<double> re0 = re, im0 = im;
  constexpr double kSigma = 0.7;
  std::vector<InterleavedLu::Lane> lanes;
  for (Index j = 0; j < columns; ++j) {
    const bool real = m[static_cast<std::size_t>(j)].imag() == 0;
    lanes.push_back({re.col(j).data(), real ? nullptr : im.col(j).data(), kSigma, 1 / kSigma});
  }
  together.solve(lanes);
  for (Index j = 0; j < columns; ++j) {
    const Mat<Complex> A = pencil.at(m[static_cast<std::size_t>(j)]);
    Filled<Complex> alone(A);
    ASSERT_EQ(alone.factorize(A), Outcome::kSuccess);
    const double sigma = lanes[static_cast<std::size_t>(j)].im ? kSigma : 0;
    Vec<Complex> y = re0.col(j) + Complex(0, sigma) * im0.col(j);
    alone.lu->solve(y.data());
    const Vec<Complex> x = re.col(j) + Complex(0, sigma) * im.col(j);
    EXPECT_LT((x - y).norm(), 1e-10 * y.norm()) << j;
  }
  if (m.front().imag() != 0) return;
  Vec<double> first = re0.col(0);
  together.solveFirst(first.data());
  EXPECT_LT((first - re.col(0)).norm(), 1e-12 * first.norm());
}

// One and more groups of lanes, half full and full; pivots off the diagonal; then other matrices with kept pivots.
TEST(InterleavedLu, AgreesWithSolvesOneByOne) {
  const Pencil pencil(saddle<double>(1), 0.05 * saddle<double>(2), 0.05 * saddle<double>(3));
  for (const int pairs : {1, 3, 4, 7, 12}) {
    for (const bool real : {true, false}) {
      SCOPED_TRACE(std::to_string(pairs) + (real ? " pairs and a real one" : " pairs"));
      std::vector<std::complex<double>> m;
      if (real) m.emplace_back(0.3);
      for (int i = 0; i < pairs; ++i) m.emplace_back(0.4 - 0.1 * i, 0.1 + 0.1 * i);
      InterleavedLu together(pencil.pattern.analysis(), m.size());
      expectTogether(together, pencil, m);
      for (auto& each : m) each *= 0.9;
      expectTogether(together, pencil, m);
      EXPECT_EQ(together.pivotings(), 1);
    }
  }
}

// Threads get groups of other widths; each lane has the same bits in all of them.
TEST(InterleavedLu, ThreadsChangeNoBit) {
  const Pencil pencil(saddle<double>(1), 0.05 * saddle<double>(2), 0.05 * saddle<double>(3));
  const Index n = pencil.D0.rows();
  for (const Index matrices : {2, 5, 11}) {
    std::vector<std::complex<double>> m{0.3};
    for (int i = 1; i < matrices; ++i) m.emplace_back(0.5 - 0.1 * i, 0.1 * i);
    const Mat<double> right = Mat<double>::Random(n, 2 * matrices);
    const auto solved = [&](int threads) {
      InterleavedLu together(pencil.pattern.analysis(), m.size(), threads);
      EXPECT_TRUE(together.factorize(pencil.view(), m));
      Mat<double> x = right;
      std::vector<InterleavedLu::Lane> lanes;
      for (Index j = 0; j < matrices; ++j) {
        lanes.push_back({x.col(2 * j).data(), j == 0 ? nullptr : x.col(2 * j + 1).data(), 0.7, 1 / 0.7});
      }
      together.solve(lanes);
      together.solveFirst(x.col(1).data());
      return x;
    };
    const Mat<double> one = solved(1);
    for (const int threads : {2, 3, 5, 8, 16}) {
      EXPECT_EQ((one - solved(threads)).cwiseAbs().maxCoeff(), 0) << threads << " threads, " << matrices << " matrices";
    }
  }
}

// m = 0 has its pivots on the diagonal, m = 1 beside it.
TEST(InterleavedLu, FollowsChangesOfPivotsAndRefusesWhereTheyDiffer) {
  Mat<double> A(2, 2), D1(2, 2), D2(2, 2);
  A << 1, 1e-14, 1e-14, 2;
  D1 << -1 + 1e-14, 1, 1, -2 + 1e-14;
  D2 << 0, 0, 0, 0;
  const Pencil pencil(A, D1, D2);
  InterleavedLu together(pencil.pattern.analysis(), 2);
  expectTogether(together, pencil, {0, {0, 0.1}});
  EXPECT_EQ(together.pivotings(), 1);
  expectTogether(together, pencil, {1, {1, 1e-15}});
  EXPECT_EQ(together.pivotings(), 2);
  EXPECT_FALSE(together.factorize(pencil.view(), std::vector<std::complex<double>>{0, {1, 1e-15}}));
  expectTogether(together, pencil, {0, {0, 0.1}});
}

TEST(InterleavedLu, RefusesWhatIsSingularOrNotFinite) {
  Mat<double> A(2, 2), D1(2, 2);
  A << 1, 2, 3, 4;
  D1 << -1, 0, -3, 0;  // m = 1: a column of zeros
  Pencil pencil(A, D1, Mat<double>::Zero(2, 2));
  InterleavedLu together(pencil.pattern.analysis(), 2);
  const std::vector<std::complex<double>> good{0.1, {0, 0.1}};
  expectTogether(together, pencil, good);
  EXPECT_FALSE(together.factorize(pencil.view(), std::vector<std::complex<double>>{0.1, 1}));
  EXPECT_FALSE(together.factorize(pencil.view(), std::vector<std::complex<double>>{1, {0, 0.1}}));
  pencil.d0[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(together.factorize(pencil.view(), good));
  pencil.d0[1] = 3;
  expectTogether(together, pencil, good);
}

TEST(SparseLu, OneUnknown) {
  const Mat<double> A = Mat<double>::Constant(1, 1, -4.0);
  Filled<double> sparse(A);
  ASSERT_EQ(sparse.factorize(A), Outcome::kSuccess);
  expectSolves(*sparse.lu, A, 1e-15);
}

}  // namespace
}  // namespace irk::test
