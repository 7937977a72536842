// Starts are consistent: constraints, their derivatives, and (a, k, z).
#include <gtest/gtest.h>

#include "tests/problems/scene_cases.h"

namespace irk::test {
namespace {

template <class Real>
void expectConsistent(const SceneCase& c, const Real& eps) {
  using std::abs;
  const auto scene = makeScene<Real>(c.id, c.settings);
  const auto reference = makeScene<double>(c.id, c.settings);
  const auto system = scene.system({});
  const auto reference_system = reference.system({});
  const Sizes n = system->sizes();
  const Vec<Real> y = pointVector(scene.start);
  const Vec<double> y_double = pointVector(reference.start);
  for (const Level level : {Level::kPosition, Level::kVelocity, Level::kAcceleration}) {
    const Vec<Real> r = residualAt<Real, Real>(*system, level, scene.start.t, y, scene.start.d);
    const Mat<double> J = automaticJacobian<double>(*reference_system, level, 0.0, y_double, reference.start.d);
    const Vec<double> rows = rowSizes(J, y_double, pointScale(reference, n));
    for (Index i = 0; i < r.size(); ++i) {
      // Solving for w multiplies the round-off of the rows' terms by its condition.
      EXPECT_LE(static_cast<double>(Real(abs(r[i]) / eps)), 1e3 * rows[i]) << "row " << i;
    }
  }
}

TEST(Start, IsConsistentInDouble) {
  for (const SceneCase& c : sceneCases()) {
    SCOPED_TRACE(c.name());
    expectConsistent<double>(c, kEps);
  }
}

TEST(Start, IsConsistentInFiftyDigits) {
  for (const SceneCase& c : sceneCases()) {
    SCOPED_TRACE(c.name());
    expectConsistent<BigFloat>(c, std::numeric_limits<BigFloat>::epsilon());
  }
}

TEST(Start, OfTheFlexibleRodKeepsThePrintedDigits) {
  const auto s = makeScene<double>("slider_crank_flexible").start;
  EXPECT_NEAR(s.v[1], -74.995767039695, 1e-12);
  EXPECT_NEAR(s.u[2], 0.4500169327969, 1e-13);
}

}  // namespace
}  // namespace irk::test
