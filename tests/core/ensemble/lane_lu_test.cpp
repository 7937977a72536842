#include "core/ensemble/lane_lu.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <complex>
#include <limits>

#include "irk/lanes.h"

namespace irk::test {
namespace {

using ComplexMatrix = Eigen::MatrixXcd;

void setLane(Lanes& to, std::size_t lane, const std::complex<double>& x) { to.set(lane, x.real()); }
void setLane(ComplexLanes& to, std::size_t lane, const std::complex<double>& x) {
  to.re.set(lane, x.real());
  to.im.set(lane, x.imag());
}
std::complex<double> lane(const Lanes& x, std::size_t i) { return x[i]; }
std::complex<double> lane(const ComplexLanes& x, std::size_t i) { return {x.re[i], x.im[i]}; }

// Random matrices whose first entry is zero, so that each lane needs its own exchange of rows.
template <class Value>
void expectSolutions(Index n) {
  LaneLu<Value> lu(n);
  std::vector<ComplexMatrix> matrices;
  std::vector<Value> y(static_cast<std::size_t>(n));
  ComplexMatrix x = ComplexMatrix::Random(n, kLanes);
  if constexpr (std::is_same_v<Value, Lanes>) x = x.real().cast<std::complex<double>>().eval();
  for (std::size_t k = 0; k < kLanes; ++k) {
    ComplexMatrix A = ComplexMatrix::Random(n, n);
    if constexpr (std::is_same_v<Value, Lanes>) A = A.real().cast<std::complex<double>>().eval();
    if (n > 1) A(0, 0) = 0;
    if (k == 5) A.row(n - 1).setZero();
    if (k == 6) A(n - 1, 0) = std::numeric_limits<double>::quiet_NaN();
    const Eigen::VectorXcd b = A * x.col(static_cast<Index>(k));
    for (Index i = 0; i < n; ++i) {
      setLane(y[static_cast<std::size_t>(i)], k, b[i]);
      for (Index j = 0; j < n; ++j) setLane(lu.at(i, j), k, A(i, j));
    }
  }
  LaneMask all;
  for (std::size_t k = 0; k < kLanes; ++k) all.set(k, true);
  const LaneFactors factors = lu.factorize(all);
  EXPECT_EQ(factors.singular.bits() & ~(1U << 6), 1U << 5) << n;
  EXPECT_EQ(factors.not_finite.bits(), 1U << 6) << n;
  lu.solve(y.data());
  for (std::size_t k = 0; k < kLanes; ++k) {
    if (k == 5 || k == 6) continue;
    for (Index i = 0; i < n; ++i) {
      EXPECT_NEAR(std::abs(lane(y[static_cast<std::size_t>(i)], k) - x(i, static_cast<Index>(k))), 0, 1e-9)
          << n << ' ' << k;
    }
  }
}

TEST(LaneLu, SolvesWithPivotsOfEachLane) {
  for (const Index n : {1, 2, 3, 8, 11}) {
    expectSolutions<Lanes>(n);
    expectSolutions<ComplexLanes>(n);
  }
}

TEST(LaneLu, ReplacesFactorsOfSomeLanesOnly) {
  LaneLu<Lanes> lu(1);
  const auto factorize = [&lu](double a, const LaneMask& which) {
    lu.at(0, 0) = a;
    static_cast<void>(lu.factorize(which));
  };
  LaneMask all, third;
  for (std::size_t k = 0; k < kLanes; ++k) all.set(k, true);
  third.set(3, true);
  factorize(2, all);
  factorize(4, third);
  Lanes y = 8;
  lu.solve(&y);
  for (std::size_t k = 0; k < kLanes; ++k) EXPECT_EQ(y[k], k == 3 ? 2 : 4) << k;
}

TEST(Lanes, HaveTheFunctionsOfNumbers) {
  const Lanes x = Lanes::each([](std::size_t i) { return 0.1 * static_cast<double>(i + 1); });
  const Dual<Lanes> y = [&] {
    Dual<Lanes> seed(x);
    seed.d[2] = 1.0;
    return exp(sin(seed)) / (1 + sqrt(seed) * tanh(seed)) - 3 * seed;
  }();
  for (std::size_t i = 0; i < kLanes; ++i) {
    Dual<double> seed(x[i]);
    seed.d[2] = 1;
    const Dual<double> expected = exp(sin(seed)) / (1 + sqrt(seed) * tanh(seed)) - 3 * seed;
    EXPECT_NEAR(y.value[i], expected.value, 1e-14) << i;
    EXPECT_NEAR(y.d[2][i], expected.d[2], 1e-13) << i;
    EXPECT_EQ(y.d[3][i], 0) << i;
  }
}

template <class T>
concept Branches = requires(const T& x) {
  x < x ? 1 : 0;
};
static_assert(Branches<double> && !Branches<Lanes>, "a residual that branches on lanes must not compile");

}  // namespace
}  // namespace irk::test
