// Exact solutions satisfy their equations and give the reference values.
#include <gtest/gtest.h>

#include <boost/math/special_functions/jacobi_elliptic.hpp>

#include "problems/support/elliptic.h"
#include "tests/problems/scene_run.h"

namespace irk::test {
namespace {

// Times at which no scene has an event.
const std::vector<double> kTimes = {0.13, 0.49, 0.97, 1.9};

TEST(Exact, SolvesTheEquations) {
  for (const SceneCase& c : sceneCases()) {
    SCOPED_TRACE(c.name());
    const auto scene = makeScene<BigFloat>(c.id, c.settings);
    if (!scene.exact) continue;
    const auto system = scene.system({Formulation::kIndex3});
    for (const double fraction : kTimes) {
      const BigFloat t = BigFloat(fraction) * scene.t_end / 2;
      const auto s = scene.exact(t);
      EXPECT_EQ(s.t, t);
      const Vec<BigFloat> r = residualAt<BigFloat, BigFloat>(*system, Level::kFormulated, t, pointVector(s), s.d);
      // 1e8: the stiffest lambda multiplies the round-off of y - phi.
      EXPECT_LT(r.lpNorm<Eigen::Infinity>(), BigFloat(1e-49 * 1e8 * 100)) << t;
      // Central differences have the truncation error delta^2 / 6 times the third derivative (below 1e8; that of the
      // motor's current is the largest).
      const BigFloat delta = 1e-16;
      const auto above = scene.exact(t + delta), below = scene.exact(t - delta);
      const BigFloat tolerance = delta * delta * 1e8;
      const auto rate = [&](const Vec<BigFloat>& up, const Vec<BigFloat>& down, const Vec<BigFloat>& value) {
        for (Index i = 0; i < up.size(); ++i) {
          const BigFloat error = (up[i] - down[i]) / (2 * delta) - value[i];
          EXPECT_LT(abs(error), tolerance) << "component " << i << " at " << t;
        }
      };
      rate(above.u, below.u, s.v);
      rate(above.v, below.v, s.a());
      rate(above.x, below.x, s.k());
    }
  }
}

// The force exceeds the yield force for 4 ms, between two steps of the exact solution. Two integrators of different
// families agree on the slider's displacement.
TEST(Exact, SeesAYieldShorterThanAStep) {
  const SceneCase c{"elastoplastic", {{"Fy", "1.85"}, {"Omega", "11.7"}, {"P0", "0.459"}, {"k", "128"}, {"m", "1.45"}}};
  const auto exact = makeScene<double>(c.id, c.settings).exact(1.8);
  EXPECT_GT(exact.x[0], 1e-5);
  for (const char* method : {"radau_iia_7", "gauss_6"}) {
    const Result r = run(c, 1.8, Discontinuity::kLocate, 1e-11, method);
    ASSERT_EQ(r.solution.outcome, Outcome::kSuccess);
    EXPECT_NEAR(r.solution.state.x[0], exact.x[0], 1e-11) << method;
    EXPECT_NEAR(r.solution.state.u[0], exact.u[0], 1e-11) << method;
  }
}

TEST(Exact, StartsAtTheStart) {
  for (const SceneCase& c : sceneCases()) {
    SCOPED_TRACE(c.name());
    const auto scene = makeScene<double>(c.id, c.settings);
    if (!scene.exact) continue;
    const Vec<double> given = pointVector(scene.start), exact = pointVector(scene.exact(0));
    const double size = 1 + given.lpNorm<Eigen::Infinity>();
    EXPECT_LE((given - exact).lpNorm<Eigen::Infinity>(), 50 * kEps * size);
  }
}

TEST(Exact, DoubleIsTheRoundedFiftyDigits) {
  for (const SceneCase& c : sceneCases()) {
    SCOPED_TRACE(c.name());
    const auto scene = makeScene<double>(c.id, c.settings);
    const auto precise = makeScene<BigFloat>(c.id, c.settings);
    if (!scene.exact) continue;
    for (const double fraction : kTimes) {
      const double t = fraction * scene.t_end / 2;
      const auto s = scene.exact(t);
      const auto exact = precise.exact(BigFloat(t));
      // The argument omega t is some hundreds, so its error is as many eps.
      const double tolerance = 1e4 * kEps;
      for (Index i = 0; i < s.u.size(); ++i) {
        EXPECT_NEAR(s.u[i], static_cast<double>(exact.u[i]), tolerance);
        EXPECT_NEAR(s.v[i], static_cast<double>(exact.v[i]), 10 * tolerance);
      }
      for (Index i = 0; i < s.x.size(); ++i) {
        EXPECT_NEAR(s.x[i], static_cast<double>(exact.x[i]), tolerance);
      }
    }
  }
}

TEST(Exact, StickSlipSwitchesWhereItShould) {
  const auto scene = makeScene<BigFloat>("stick_slip");
  const auto stuck = [&](const char* t) { return scene.exact(BigFloat(t)).v[0] == BigFloat("0.1"); };
  EXPECT_TRUE(stuck("14.999999999999"));
  EXPECT_FALSE(stuck("15.000000000001"));
  EXPECT_FALSE(stuck("18.536383773289"));
  EXPECT_TRUE(stuck("18.536383773290"));
  EXPECT_TRUE(stuck("28.536383773289"));
  EXPECT_FALSE(stuck("28.536383773290"));
  EXPECT_FALSE(stuck("45.609151319868"));
  EXPECT_TRUE(stuck("45.609151319869"));
}

TEST(Exact, CoulombDecayComesToRest) {
  const SceneCase c = sceneCases().back();
  ASSERT_EQ(c.settings.at("x0"), "0.105");
  const auto scene = makeScene<double>(c.id, c.settings);
  for (const double t : {1.5708, 2.0, 50.0}) {
    EXPECT_NEAR(scene.exact(t).u[0], -0.005, 100 * kEps);
    EXPECT_EQ(scene.exact(t).v[0], 0);
    EXPECT_EQ(scene.exact(t).w[0], 0);
  }
}

TEST(Exact, EllipticFunctionsAgreeWithBoostToFortyFiveDigits) {
  for (const char* m : {"0.1", "0.5", "0.99"}) {
    for (const char* u : {"0.2", "1.7", "31.3"}) {
      BigFloat cn, dn;
      const BigFloat sn = boost::math::jacobi_elliptic(BigFloat(sqrt(BigFloat(m))), BigFloat(u), &cn, &dn);
      const auto f = jacobiFunctions<BigFloat>(BigFloat(u), BigFloat(m));
      EXPECT_LT(abs(f.sn - sn), BigFloat("1e-45")) << u << " " << m;
      EXPECT_LT(abs(f.cn - cn), BigFloat("1e-45")) << u << " " << m;
      EXPECT_LT(abs(f.dn - dn), BigFloat("1e-45")) << u << " " << m;
    }
  }
}

TEST(Exact, EllipticFunctionsOfDoublesAgreeWithBoost) {
  for (const double m : {0.0, 0.1, 0.5, 0.9, 0.999}) {
    for (const double u : {-3.0, 0.0, 0.2, 1.7, 10.0, 31.3}) {
      double cn, dn;
      const double sn = boost::math::jacobi_elliptic(std::sqrt(m), u, &cn, &dn);
      const auto f = jacobiFunctions<double>(u, m);
      const double tolerance = 50 * kEps * (1 + std::abs(u));
      EXPECT_NEAR(f.sn, sn, tolerance) << u << " " << m;
      EXPECT_NEAR(f.cn, cn, tolerance) << u << " " << m;
      EXPECT_NEAR(f.dn, dn, tolerance) << u << " " << m;
      const auto precise = jacobiFunctions<BigFloat>(u, m);
      EXPECT_NEAR(f.sn, static_cast<double>(precise.sn), tolerance) << u << " " << m;
    }
  }
}

}  // namespace
}  // namespace irk::test
