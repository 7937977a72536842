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

// Random matrices whose first entry is zero, so that each lane needs its own exchange of rows.
template <class Value>
void expectSolutions(Index n) {
  LaneLu<Value> lu(n);
  std::vector<ComplexMatrix> matrices;
  const bool is_complex = std::is_same_v<Value, ComplexLanes>;
  const auto place = [&](Index i) { return static_cast<std::size_t>(is_complex ? 2 * i : i); };  // of entry i
  std::vector<Lanes> y(place(n));
  std::vector<Value> entries(static_cast<std::size_t>(n * n));
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
      y[place(i)].set(k, b[i].real());
      if (is_complex) y[place(i) + 1].set(k, b[i].imag());
      for (Index j = 0; j < n; ++j) setLane(entries[static_cast<std::size_t>(i + j * n)], k, A(i, j));
    }
  }
  LaneMask all;
  for (std::size_t k = 0; k < kLanes; ++k) all.set(k, true);
  const LaneFactors factors =
      lu.factorize(all, [&](Index i, Index j) { return entries[static_cast<std::size_t>(i + j * n)]; });
  EXPECT_EQ(factors.singular.bits() & ~(1U << 6), 1U << 5) << n;
  EXPECT_EQ(factors.not_finite.bits(), 1U << 6) << n;
  lu.solve(y.data());
  for (std::size_t k = 0; k < kLanes; ++k) {
    if (k == 5 || k == 6) continue;
    for (Index i = 0; i < n; ++i) {
      const std::complex<double> computed(y[place(i)][k], is_complex ? y[place(i) + 1][k] : 0.0);
      EXPECT_NEAR(std::abs(computed - x(i, static_cast<Index>(k))), 0, 1e-9) << n << ' ' << k;
    }
  }
}

TEST(LaneLu, SolvesWithPivotsOfEachLane) {
  for (const Index n : {1, 2, 3, 4, 5, 6, 7, 8, 9, 11}) {
    expectSolutions<Lanes>(n);
    expectSolutions<ComplexLanes>(n);
  }
}

LaneMask maskOf(std::initializer_list<std::size_t> lanes) {
  LaneMask mask;
  for (const std::size_t k : lanes) mask.set(k, true);
  return mask;
}

// New factors of some lanes, with exchanges of rows of their own or with NaN, leave the bits of the others.
template <class Value>
void expectOthersStay(Index n) {
  const auto size = static_cast<std::size_t>(n);
  constexpr int kParts = static_cast<int>(sizeof(Value) / sizeof(Lanes));
  LaneLu<Value> lu(n);
  const auto factorize = [&](const LaneMask& which, double middle) {
    std::vector<Value> entries(size * size);
    for (Index i = 0; i < n; ++i) {
      for (Index j = 0; j < n; ++j) {
        for (std::size_t k = 0; k < kLanes; ++k) {
          const std::complex<double> random(Vec<double>::Random(1)[0], Vec<double>::Random(1)[0]);
          setLane(entries[static_cast<std::size_t>(i + j * n)], k, i == j ? random + middle : random);
        }
      }
    }
    static_cast<void>(
        lu.factorize(which, [&](Index i, Index j) { return entries[static_cast<std::size_t>(i + j * n)]; }));
  };
  const auto solution = [&] {
    std::vector<Lanes> y(size * kParts);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = std::cos(static_cast<double>(i));
    lu.solve(y.data());
    return y;
  };
  const auto expectChanges = [&](const LaneMask& which, double middle) {
    const auto before = solution();
    factorize(which, middle);
    const auto after = solution();
    for (std::size_t k = 0; k < kLanes; ++k) {
      bool same = true;
      for (std::size_t i = 0; i < before.size(); ++i) same = same && before[i][k] == after[i][k];
      EXPECT_NE(same, which[k]) << n << " " << k;
    }
  };
  factorize(maskOf({0, 1, 2, 3, 4, 5, 6, 7}), 0);
  expectChanges(maskOf({1, 3}), 0);
  expectChanges(maskOf({2}), 10);  // without exchanges
  expectChanges(maskOf({5}), std::numeric_limits<double>::quiet_NaN());
}

TEST(LaneLu, ReplacesFactorsOfSomeLanesOnly) {
  for (const Index n : {1, 2, 3, 8, 9}) {
    expectOthersStay<Lanes>(n);
    expectOthersStay<ComplexLanes>(n);
  }
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

// Each function over its domain, in every lane, with errors of a few units in the last place.
TEST(Lanes, FunctionsEqualThoseOfTheStandardLibrary) {
  const auto expectEqual = [](const char* name, double from, double to, const auto& of_lanes, const auto& of_numbers) {
    constexpr int kPoints = 1000;
    for (int k = 0; k + 8 <= kPoints; k += 8) {
      const Lanes x =
          Lanes::each([&](std::size_t i) { return from + (to - from) * (k + static_cast<double>(i) + 0.5) / kPoints; });
      const Lanes y = of_lanes(x);
      for (std::size_t i = 0; i < kLanes; ++i) {
        const double expected = of_numbers(x[i]);
        EXPECT_NEAR(y[i], expected, 1e-15 * std::abs(expected)) << name << "(" << x[i] << ")";
      }
    }
  };
#define IRK_EXPECT_EQUAL(f, from, to) \
  expectEqual(                        \
      #f, from, to, [](const Lanes& x) { return f(x); }, [](double x) { return std::f(x); })
  IRK_EXPECT_EQUAL(sqrt, 0, 1e6);
  IRK_EXPECT_EQUAL(cbrt, -20, 20);
  IRK_EXPECT_EQUAL(exp, -700, 700);
  IRK_EXPECT_EQUAL(expm1, -5, 5);
  IRK_EXPECT_EQUAL(log, 1e-3, 50);
  IRK_EXPECT_EQUAL(log1p, -0.99, 5);
  IRK_EXPECT_EQUAL(sin, -100, 100);
  IRK_EXPECT_EQUAL(cos, -100, 100);
  IRK_EXPECT_EQUAL(tan, -100, 100);
  IRK_EXPECT_EQUAL(asin, -1, 1);
  IRK_EXPECT_EQUAL(acos, -1, 1);
  IRK_EXPECT_EQUAL(atan, -20, 20);
  IRK_EXPECT_EQUAL(sinh, -20, 20);
  IRK_EXPECT_EQUAL(cosh, -20, 20);
  IRK_EXPECT_EQUAL(tanh, -20, 20);
#undef IRK_EXPECT_EQUAL
  for (const double other : {-1.5, 0.25, 3.0}) {
    const auto expectTwo = [&](const char* name, double from, const auto& f) {
      expectEqual(
          name, from, 9, [&](const Lanes& x) { return f(x, Lanes(other)); }, [&](double x) { return f(x, other); });
    };
    using std::atan2, std::hypot, std::pow;
    expectTwo("pow", 1e-3, [](const auto& a, const auto& b) { return pow(a, b); });
    expectTwo("atan2", -9, [](const auto& a, const auto& b) { return atan2(a, b); });
    expectTwo("hypot", -9, [](const auto& a, const auto& b) { return hypot(a, b); });
  }
  EXPECT_NEAR(pow(Lanes(-1.5), Lanes(3))[0], -3.375, 1e-15);
  EXPECT_NEAR(hypot(Lanes(3e200), Lanes(4e200))[0], 5e200, 5e185);
  for (const double tiny : {1e-300, -1e-20, 1e-9}) {
    EXPECT_NEAR(expm1(Lanes(tiny))[0], tiny, std::abs(tiny) * 1e-8);
    EXPECT_NEAR(log1p(Lanes(tiny))[0], tiny, std::abs(tiny) * 1e-8);
    EXPECT_NEAR(sinh(Lanes(tiny))[0], tiny, std::abs(tiny) * 1e-8);
  }
  // Outside of their domain, and in one lane only.
  const Lanes x = Lanes::each([](std::size_t i) { return i == 3 ? -1.0 : 2.0; });
  EXPECT_TRUE(std::isnan(log(x)[3]) && std::isnan(sqrt(x)[3]) && std::isnan(pow(x, Lanes(0.5))[3]));
  EXPECT_NEAR(log(x)[2], std::log(2), 1e-15);
  EXPECT_EQ(exp(1000 * x)[2], std::numeric_limits<double>::infinity());
  EXPECT_EQ(exp(1000 * x)[3], 0);
}

// A number that needs another way of computing leaves the bits of its neighbours.
TEST(Lanes, FunctionsOfALaneDoNotDependOnOthers) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity(), kNan = std::numeric_limits<double>::quiet_NaN();
  const auto expectSame = [&](const char* name, const auto& f) {
    for (const double x : {0.3, 0.7}) {
      const Lanes alone = f(Lanes(x));
      for (const double other : {kNan, kInfinity, -kInfinity, 1e300, -1e300, 5e-324, 1e5, -1.0, 0.0}) {
        for (std::size_t at = 0; at < kLanes; ++at) {
          Lanes mixed(x);
          mixed.set(at, other);
          const Lanes y = f(mixed);
          for (std::size_t i = 0; i < kLanes; ++i) {
            if (i == at) continue;
            EXPECT_EQ(y[i], alone[i]) << name << " " << x << " beside " << other;
          }
        }
      }
    }
  };
#define IRK_EXPECT_SAME(f) expectSame(#f, [](const Lanes& x) { return f(x); })
  IRK_EXPECT_SAME(sqrt);
  IRK_EXPECT_SAME(cbrt);
  IRK_EXPECT_SAME(exp);
  IRK_EXPECT_SAME(expm1);
  IRK_EXPECT_SAME(log);
  IRK_EXPECT_SAME(log1p);
  IRK_EXPECT_SAME(sin);
  IRK_EXPECT_SAME(cos);
  IRK_EXPECT_SAME(tan);
  IRK_EXPECT_SAME(asin);
  IRK_EXPECT_SAME(acos);
  IRK_EXPECT_SAME(atan);
  IRK_EXPECT_SAME(sinh);
  IRK_EXPECT_SAME(cosh);
  IRK_EXPECT_SAME(tanh);
#undef IRK_EXPECT_SAME
  expectSame("pow", [](const Lanes& x) { return pow(x, Lanes(0.8)); });
  expectSame("pow of 0.8", [](const Lanes& x) { return pow(Lanes(0.8), x); });
  expectSame("atan2", [](const Lanes& x) { return atan2(x, Lanes(0.8)); });
  expectSame("hypot", [](const Lanes& x) { return hypot(x, Lanes(0.8)); });
}

template <class T>
concept Branches = requires(const T& x) {
  x < x ? 1 : 0;
};
static_assert(Branches<double> && !Branches<Lanes>, "a residual that branches on lanes must not compile");

}  // namespace
}  // namespace irk::test
