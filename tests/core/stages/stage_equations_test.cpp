// The kernels of a step, of every size that is unrolled and of some that are not, against general products.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/stages/error_norm.h"
#include "core/stages/stage_equations.h"
#include "tests/core/support.h"

namespace irk::test {
namespace {

/// u'' = u + 2 u', x' = x for each component.
struct Uncoupled {
  Index nu, nx;

  Sizes sizes() const { return {.nu = nu, .nx = nx, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    for (Index i = 0; i < nu; ++i) r.u[i] = p.u[i] + 2 * p.v[i] - p.a[i];
    for (Index i = 0; i < nx; ++i) r.x[i] = p.x[i] - p.k[i];
  }
};

State<double> anyState(const Sizes& sizes) {
  State<double> state(sizes);
  state.u.setRandom();
  state.v.setRandom();
  state.x.setRandom();
  return state;
}

template <class Check>
void forSizes(Check&& check) {
  for (const Index s : {1, 2, 3, 5}) {
    const Scheme<double> scheme(makeTableau<double>("radau_iia_" + std::to_string(s)));
    for (const Index nu : {0, 1, 2, 4, 5}) {
      for (const Index nx : {0, 1, 3, 4, 6}) {
        if (nu + nx > 0) check(scheme, Uncoupled{nu, nx});
      }
    }
  }
}

constexpr double kStageStep = 0.3;

TEST(StageEquations, ResidualsOfEverySize) {
  forSizes([](const Scheme<double>& scheme, const Uncoupled& problem) {
    const auto system = makeSystem<double>(problem);
    const Index nu = problem.nu, nx = problem.nx;
    StageEquations<double> equations(*system, scheme, Summation::kPlain, 1);
    const State<double> from = anyState(system->sizes());
    equations.begin(from, kStageStep);
    const Mat<double> W = Mat<double>::Random(nu + nx, scheme.s);
    Mat<double> R(nu + nx, scheme.s), expected(nu + nx, scheme.s);
    ASSERT_TRUE(equations.residual(W, R));
    const Mat<double> A = W.topRows(nu), K = W.bottomRows(nx);
    Mat<double> V = kStageStep * A * scheme.A.transpose(), U = kStageStep * kStageStep * A * scheme.A2.transpose();
    V.colwise() += from.v;
    U.colwise() += from.u;
    U += kStageStep * from.v * scheme.A1.transpose();
    Mat<double> X = kStageStep * K * scheme.A.transpose();
    X.colwise() += from.x;
    expected << U + 2 * V - A, X - K;
    EXPECT_LT((R - expected).norm(), 1e-13) << nu << " " << nx << " " << scheme.s;
  });
}

TEST(StageEquations, DetectsANumberThatIsNotFiniteAnywhere) {
  forSizes([](const Scheme<double>& scheme, const Uncoupled& problem) {
    const auto system = makeSystem<double>(problem);
    StageEquations<double> equations(*system, scheme, Summation::kPlain, 1);
    const State<double> from = anyState(system->sizes());
    equations.begin(from, kStageStep);
    const Mat<double> good = Mat<double>::Random(system->sizes().n(), scheme.s);
    Mat<double> R = good;
    for (Index i = 0; i < good.size(); ++i) {
      for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        Mat<double> W = good;
        W.data()[i] = bad;
        EXPECT_FALSE(equations.residual(W, R)) << i << " " << bad;
      }
    }
    EXPECT_TRUE(equations.residual(good, R));
  });
}

TEST(StageEquations, EndsOfEverySizeWithBothSummations) {
  forSizes([](const Scheme<double>& scheme, const Uncoupled& problem) {
    const auto system = makeSystem<double>(problem);
    const Index nu = problem.nu, nx = problem.nx;
    const State<double> from = anyState(system->sizes());
    const Mat<double> W = Mat<double>::Random(nu + nx, scheme.s);
    const Mat<double> A = W.topRows(nu), K = W.bottomRows(nx);
    for (const Summation summation : {Summation::kPlain, Summation::kCompensated}) {
      StageEquations<double> equations(*system, scheme, summation, 1);
      equations.begin(from, kStageStep);
      State<double> to(system->sizes());
      equations.finish(W, to);
      EXPECT_LT((to.u - from.u - kStageStep * from.v - kStageStep * kStageStep * A * scheme.bA).norm(), 1e-14);
      EXPECT_LT((to.v - from.v - kStageStep * A * scheme.b).norm(), 1e-14);
      EXPECT_LT((to.x - from.x - kStageStep * K * scheme.b).norm(), 1e-14);
      EXPECT_EQ(to.w, W.col(scheme.s - 1));
    }
  });
}

TEST(ErrorNorm, IncrementsOfEverySize) {
  for (Index n = 1; n <= 20; ++n) {
    const auto system = makeSystem<double>(Uncoupled{0, n});
    const ErrorNorm<double> norm(*system, {.rtol = 1e-3, .atol = 1e-3}, {});
    for (Index s = 1; s <= 5; ++s) {
      for (Index first = 0; first < std::min<Index>(s, 2); ++first) {
        const Mat<double> dW = Mat<double>::Random(n, s);
        const Vec<double> squares = Vec<double>::Random(n).cwiseAbs();
        const Mat<double> counted = dW.rightCols(s - first);
        const double sum = (squares.asDiagonal() * counted.cwiseAbs2()).sum();
        const double expected = std::sqrt(sum / static_cast<double>(counted.size()));
        EXPECT_NEAR(norm.increment(dW, first, squares), expected, 1e-15 * expected * 20) << n << " " << s;
      }
    }
  }
}

TEST(ErrorNorm, ErrorsOfEverySize) {
  for (Index n = 1; n <= 20; ++n) {
    const auto system = makeSystem<double>(Uncoupled{n, 2 * n + 1});
    ErrorNorm<double> norm(*system, {.rtol = 1e-3, .atol = 1e-4}, {});
    State<double> y(system->sizes()), e(system->sizes());
    y.u.setRandom(), y.v.setRandom(), y.x.setRandom();
    e.u.setRandom(), e.v.setRandom(), e.x.setRandom();
    norm.update(y);
    Vec<double> all(4 * n + 1), weights(4 * n + 1);
    all << e.u, e.v, e.x;
    weights << y.u, y.v, y.x;
    weights = 1e-4 + 1e-3 * weights.array().abs();
    const double expected = std::sqrt(all.cwiseQuotient(weights).squaredNorm() / static_cast<double>(all.size()));
    EXPECT_NEAR(norm.magnitude(e, 0.1), expected, 1e-14 * expected) << n;
  }
}

}  // namespace
}  // namespace irk::test
