// Consistency of every scene's residual: derivatives, multipliers, precision.
#include <gtest/gtest.h>

#include "core/system/counting.h"
#include "tests/problems/scene_cases.h"

namespace irk::test {
namespace {

// Central differences of the 50-digit residual with delta = 1e-15 scale: truncation and round-off are both below
// 1e-25, relative to the terms of the row.
Mat<double> differenceJacobian(const System<BigFloat>& system, Level level, const BigFloat& t, const Vec<double>& y,
                               const Vec<double>& d, const Vec<double>& scale) {
  const Vec<BigFloat> at = y.cast<BigFloat>(), modes = d.cast<BigFloat>();
  Mat<double> J(system.sizes().n(), y.size());
  for (Index j = 0; j < y.size(); ++j) {
    const BigFloat delta = BigFloat(1e-15) * scale[j];
    Vec<BigFloat> above = at, below = at;
    above[j] += delta;
    below[j] -= delta;
    const Vec<BigFloat> difference = residualAt<BigFloat, BigFloat>(system, level, t, above, modes) -
                                     residualAt<BigFloat, BigFloat>(system, level, t, below, modes);
    J.col(j) = (difference / BigFloat(2 * delta)).cast<double>();
  }
  return J;
}

// The automatic derivative adds the same terms as the residual, with a few operations each.
constexpr double kDerivativeTolerance = 1e4 * kEps;

void expectDerivativesAgree(const System<double>& system, const System<BigFloat>& precise, Level level,
                            const Vec<double>& y, const Vec<double>& d, const Vec<double>& scale) {
  const Mat<double> J = automaticJacobian<double>(system, level, 0.0, y, d);
  const Mat<double> D = differenceJacobian(precise, level, 0, y, d, scale);
  const Vec<double> magnitude = y.cwiseAbs().cwiseMax(scale);
  const Vec<double> rows = J.cwiseAbs() * magnitude;
  for (Index i = 0; i < J.rows(); ++i) {
    for (Index j = 0; j < J.cols(); ++j) {
      EXPECT_NEAR(J(i, j) * magnitude[j], D(i, j) * magnitude[j], kDerivativeTolerance * rows[i])
          << "row " << i << " column " << j;
    }
  }
}

TEST(Residual, AutomaticDerivativeIsTheDifferenceQuotient) {
  for (const SceneCase& c : sceneCases()) {
    SCOPED_TRACE(c.name());
    const auto scene = makeScene<double>(c.id, c.settings);
    const auto precise = makeScene<BigFloat>(c.id, c.settings);
    const Vec<double> start = pointVector(scene.start), moved = perturbedPoint(scene, scene.sizes());
    for (const Mode& mode : modesToTest(scene)) {
      for (const Formulation formulation : kFormulations) {
        const SystemOptions options{formulation, ConstraintScaling::kOn, mode.discontinuity};
        const auto system = scene.system(options);
        const auto precise_system = precise.system(options);
        const Vec<double> scale = pointScale(scene, system->sizes());
        for (const Level level : {Level::kFormulated, Level::kAcceleration}) {
          // The start may lie on a switch.
          if (mode.discontinuity != Discontinuity::kIgnore) {
            expectDerivativesAgree(*system, *precise_system, level, start, mode.d, scale);
          }
          expectDerivativesAgree(*system, *precise_system, level, moved, mode.d, scale);
        }
      }
    }
  }
}

// Evaluating all stages in one call gives bitwise the residuals of calls with one stage, as several threads make them,
// and the same count. evaluate() may round in another way.
TEST(Residual, StagesAtOnceAreTheirResidualsOneByOne) {
  constexpr Index kStages = 3;
  for (const SceneCase& c : sceneCases()) {
    const auto scene = makeScene<double>(c.id, c.settings);
    for (const Mode& mode : modesToTest(scene)) {
      for (const Formulation formulation : kFormulations) {
        SCOPED_TRACE(c.name());
        const auto system = scene.system({formulation, ConstraintScaling::kOn, mode.discontinuity});
        Counters counters;
        const CountingSystem<double> counted(*system, counters);
        const Sizes n = system->sizes();
        const Vec<double> y = perturbedPoint(scene, n);
        std::vector<Vec<double>> at;
        Mat<double> u(n.nu, kStages), v(n.nu, kStages), x(n.nx, kStages), w(n.n(), kStages);
        Vec<double> t(kStages);
        for (Index i = 0; i < kStages; ++i) {
          t[i] = 0.1 * static_cast<double>(i);
          at.push_back((1 + t[i]) * y);
          u.col(i) = at.back().head(n.nu);
          v.col(i) = at.back().segment(n.nu, n.nu);
          x.col(i) = at.back().segment(2 * n.nu, n.nx);
          w.col(i) = at.back().tail(n.n());
        }
        Mat<double> r = Mat<double>::Constant(n.n(), kStages, -77);
        const StagePoints<double> points{n, t.data(), u.data(), v.data(), x.data(), w.data(), mode.d.data()};
        counted.evaluateStages(points, 1, kStages, r.data());
        EXPECT_EQ(counters.residuals, kStages - 1);
        Mat<double> single = r;
        for (Index i = 1; i < kStages; ++i) {
          const Vec<double> one =
              residualAt(*system, Level::kFormulated, t[i], at[static_cast<std::size_t>(i)], mode.d);
          EXPECT_LE((r.col(i) - one).norm(), 1e-9 * (1 + one.norm())) << "stage " << i;
          single.col(i).setConstant(-77);
          system->evaluateStages(points, i, i + 1, single.data());
          EXPECT_TRUE((r.col(i).array() == single.col(i).array()).all()) << "stage " << i;
        }
        EXPECT_TRUE((r.col(0).array() == -77).all()) << "was not asked for";
        // Points that are no stages go to the first columns.
        Mat<double> points_only(n.n(), kStages - 1);
        counted.evaluatePoints(points, 1, kStages, points_only.data());
        EXPECT_EQ(counters.residuals, 2 * (kStages - 1));
        EXPECT_LE((points_only - r.rightCols(kStages - 1)).norm(), 1e-9 * (1 + r.rightCols(kStages - 1).norm()));
      }
    }
  }
}

// The struct contains G^T lambda written by hand: dr_u/dlambda = -(dg/du)^T.
TEST(Residual, MultipliersActThroughTheConstraintJacobian) {
  for (const SceneCase& c : sceneCases()) {
    SCOPED_TRACE(c.name());
    const auto scene = makeScene<double>(c.id, c.settings);
    const Sizes n = scene.sizes();
    const auto system = scene.system({Formulation::kIndex3});
    const Mat<double> J =
        automaticJacobian<double>(*system, Level::kPosition, 0.0, perturbedPoint(scene, n), scene.start.d);
    const Index first = n.nu + n.nx;
    const Index lambda = 2 * n.nu + n.nx + first;  // column in (u, v, x, a, k, z)
    const Mat<double> by_lambda = J.block(0, lambda, n.nu, n.constraints);
    const Mat<double> G = J.block(first, 0, n.constraints, n.nu);
    const double size = 1 + (G.size() > 0 ? G.cwiseAbs().maxCoeff() : 0);
    for (Index i = 0; i < n.nu; ++i) {
      for (Index j = 0; j < n.constraints; ++j) {
        EXPECT_NEAR(by_lambda(i, j), -G(j, i), 10 * kEps * size) << i << " " << j;
      }
    }
  }
}

TEST(Residual, FiftyDigitsAgreeWithDouble) {
  for (const SceneCase& c : sceneCases()) {
    SCOPED_TRACE(c.name());
    const auto scene = makeScene<double>(c.id, c.settings);
    const auto precise = makeScene<BigFloat>(c.id, c.settings);
    const Sizes n = scene.sizes();
    const Vec<double> y = perturbedPoint(scene, n);
    for (const Mode& mode : modesToTest(scene)) {
      for (const Formulation formulation : kFormulations) {
        const SystemOptions options{formulation, ConstraintScaling::kOn, mode.discontinuity};
        const auto system = scene.system(options);
        const auto precise_system = precise.system(options);
        const double t = std::min(0.25, scene.t_end / 4);
        const Level level = Level::kFormulated;
        const Vec<double> r = residualAt<double, double>(*system, level, t, y, mode.d);
        const Vec<BigFloat> exact =
            residualAt<BigFloat, BigFloat>(*precise_system, level, t, y.cast<BigFloat>(), mode.d.cast<BigFloat>());
        const Mat<double> J = automaticJacobian<double>(*system, level, t, y, mode.d);
        const Vec<double> rows = rowSizes(J, y, pointScale(scene, n));
        for (Index i = 0; i < r.size(); ++i) {
          EXPECT_NEAR(r[i], static_cast<double>(exact[i]), 1e-13 * (rows[i] + std::abs(r[i]))) << "row " << i;
        }
      }
    }
  }
}

// All formulations describe one system: they agree in all rows except those of the constraints.
TEST(Residual, FormulationsDifferInConstraintRowsOnly) {
  for (const SceneCase& c : sceneCases()) {
    SCOPED_TRACE(c.name());
    const auto scene = makeScene<double>(c.id, c.settings);
    const Sizes n = scene.sizes();
    const Vec<double> y = perturbedPoint(scene, n);
    const auto index3 = scene.system({Formulation::kIndex3});
    const auto index2 = scene.system({Formulation::kIndex2, ConstraintScaling::kOff});
    const Vec<double> r3 = residualAt<double, double>(*index3, Level::kFormulated, 0, y, scene.start.d);
    const Vec<double> r2 = residualAt<double, double>(*index2, Level::kFormulated, 0, y, scene.start.d);
    EXPECT_EQ(r3.head(n.nu + n.nx), r2.head(n.nu + n.nx));
    const Index rest = n.nz - n.constraints;
    EXPECT_EQ(r3.tail(rest), r2.tail(rest));
  }
}

}  // namespace
}  // namespace irk::test
