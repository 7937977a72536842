// Compares Broyden's updates with explicitly updated matrices, and counts the work that they save.
#include "core/newton/broyden.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "tests/core/support.h"

namespace irk::test {
namespace {

// F(x) = 0 in n unknowns, mildly nonlinear, with the root (1, ..., n)/n.
Vec<double> residual(const Vec<double>& x) {
  const Index n = x.size();
  Vec<double> f(n);
  for (Index i = 0; i < n; ++i) {
    const auto size = static_cast<double>(n);
    const double root = static_cast<double>(i + 1) / size, e = x[i] - root;
    f[i] = 2 * e + 0.4 * e * e;
    for (Index j = 0; j < n; ++j) {
      f[i] += 0.6 / size * static_cast<double>(1 + (i * j) % 3) * (x[j] - static_cast<double>(j + 1) / size);
    }
  }
  return f;
}

// The update, written out: B := B + (F_new - F_old - B s) s^T W / (s^T W s).
void compareWithUpdatedMatrices(Index rows) {
  constexpr Index kStages = 2;
  const Index size = rows * kStages;
  Vec<double> squares(rows);
  for (Index i = 0; i < rows; ++i) squares[i] = std::pow(4.0, i % 3 - 1);
  Vec<double> weights(size);
  for (Index j = 0; j < kStages; ++j) weights.segment(j * rows, rows) = squares;
  Mat<double> B = 2.5 * Mat<double>::Identity(size, size);
  const Eigen::PartialPivLU<Mat<double>> simplified(B);

  BroydenUpdates<double> updates(rows, kStages);
  updates.begin(true, squares);
  Vec<double> x = Vec<double>::Zero(size), twin = x, f = residual(twin);
  for (int m = 0; m < 7; ++m) {
    Vec<double> d = simplified.solve(residual(x));
    VecView<double> view(d.data(), size);
    updates.apply(view);
    const Vec<double> step = -B.partialPivLu().solve(f);
    EXPECT_LT((d + step).norm(), 1e-9 * step.norm() + 1e-14) << m;
    updates.learn(view);
    x -= d;
    twin += step;
    const Vec<double> next = residual(twin);
    const Vec<double> dual = weights.cwiseProduct(step);
    B += (next - f - B * step) * dual.transpose() / dual.dot(step);
    f = next;
  }
  // Convergence is superlinear; the simplified iteration contracts by 0.4.
  EXPECT_LT(residual(x).norm(), 1e-5);
}

TEST(Broyden, AgreesWithTheUpdatedMatrices) {
  compareWithUpdatedMatrices(3);
  compareWithUpdatedMatrices(70);  // weights of one stage are kept
}

TEST(Broyden, SkipsUpdatesThatWouldNotBeSafe) {
  BroydenUpdates<double> updates(2, 1);
  const Vec<double> squares = Vec<double>::Ones(2);
  Vec<double> d = (Vec<double>(2) << 1.0, 0.0).finished();
  VecView<double> view(d.data(), 2);
  updates.begin(true, squares);
  updates.apply(view);
  updates.learn(view);
  Vec<double> worse = (Vec<double>(2) << 0.75, 0.5).finished();  // alpha = 3/4
  VecView<double> second(worse.data(), 2);
  updates.apply(second);
  EXPECT_EQ(worse, (Vec<double>(2) << 0.75, 0.5).finished());
  updates.learn(second);
  Vec<double> third = (Vec<double>(2) << 0.1, 0.0).finished();
  VecView<double> again(third.data(), 2);
  updates.apply(again);
  EXPECT_EQ(third, (Vec<double>(2) << 0.1, 0.0).finished());
}

TEST(Broyden, SavesIterationsWhereTheMatrixIsOld) {
  const auto run = [](NewtonKind newton) {
    IntegratorOptions o = fixedSteps(0.05);
    o.newton.kind = newton;
    o.newton.keep_jacobian_below = 0.9;  // one Jacobian as long as it contracts
    const auto s =
        integrate<double>(CartesianPendulum{}, pendulumStart<double>(), 2, makeTableau<double>("radau_iia_3"), o);
    EXPECT_EQ(s.outcome, Outcome::kSuccess) << s.detail;
    return s;
  };
  const auto simplified = run(NewtonKind::kSimplified), broyden = run(NewtonKind::kBroyden);
  EXPECT_LT(10 * broyden.counters.newton_iterations, 8 * simplified.counters.newton_iterations);
  EXPECT_LT((broyden.state.u - simplified.state.u).norm(), 1e-11);
}

}  // namespace
}  // namespace irk::test
