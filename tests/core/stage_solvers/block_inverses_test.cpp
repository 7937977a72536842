// Inverses of blocks against the solution of the block written out, on any processor: where vector registers are short,
// stage solvers do not use the larger ones.
#include "core/stage_solvers/block_inverses.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>
#include <vector>

#include "core/base/small_size.h"
#include "irk/tableaus.h"

namespace irk::test {
namespace {

using ComplexMat = Mat<std::complex<double>>;
using ComplexVec = Vec<std::complex<double>>;

TEST(BlockInverses, SolveEachBlock) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  const auto random = [&](Index size) {
    return Vec<double>(Vec<double>::NullaryExpr(size, [&](Index) { return normal(generator); }));
  };
  const auto form = eigenForm(makeTableau<double>("radau_iia_3").A);  // a real eigenvalue and a complex pair
  ASSERT_EQ(form->blocks.size(), 2u);
  constexpr double kH = 0.37;
  for (Index n = 1; n <= kMostPadded; ++n) {
    SCOPED_TRACE(n);
    Linearization<double> D(Pattern::dense(n));
    D.d0 = random(n * n);
    D.d1 = random(n * n);
    D.d2 = random(n * n);
    std::vector<int> powers(static_cast<std::size_t>(n), 0);
    powers.back() = 1;
    Vec<double> scales = Vec<double>::Ones(n);
    scales[n - 1] = 1 / kH;
    BlockInverses inverses(*form, powers, n);
    for (std::size_t k = 0; k < form->blocks.size(); ++k) {
      const auto& block = form->blocks[k];
      ASSERT_EQ(inverses.invert(k, D, kH, scales), Outcome::kSuccess);
      const std::complex<double> m = kH * block.mu;
      ComplexMat M = D.dense0().cast<std::complex<double>>() + m * D.dense1() + m * m * D.dense2();
      M.row(n - 1) /= kH;
      const Vec<double> given = random(block.size * n);
      ComplexVec y = given.head(n).cast<std::complex<double>>();
      if (block.size == 2) y.imag() = block.sigma * given.tail(n);
      const ComplexVec z = M.fullPivLu().solve(y);
      Vec<double> expected(block.size * n), found = given;
      expected.head(n) = z.real();
      if (block.size == 2) expected.tail(n) = z.imag() / block.sigma;
      withSize<kSmallInverse>(n, [&](auto size) { inverses.multiply(k, found.data(), size); });
      const double condition = M.norm() * M.inverse().norm();
      EXPECT_LT((found - expected).norm(), 1e-15 * condition * expected.norm()) << k;
    }
  }
}

}  // namespace
}  // namespace irk::test
