// ANCF beams: static limit and energy.
#include <gtest/gtest.h>

#include <map>

#include "tests/problems/equilibrium.h"
#include "tests/problems/scene_cases.h"

namespace irk::test {
namespace {

// The load is applied in ten steps: for the complete load Newton does not converge from the straight beam.
template <class Real>
std::optional<State<Real>> bentCantilever(const std::string& elements) {
  std::optional<State<Real>> bent = makeScene<Real>("ancf_cantilever", {{"elements", elements}}).start;
  for (int i = 1; i <= 10 && bent; ++i) {
    const std::string f = i == 10 ? "3EI/L^2" : std::to_string(3 * 2.07e11 * 1e-4 / 12 / 4 * i / 10);
    const auto scene = makeScene<Real>("ancf_cantilever", {{"elements", elements}, {"f", f}});
    bent = equilibriumOf(*scene.system({Formulation::kIndex3}), *bent);
  }
  return bent;
}

struct TipDeflection {
  double u_x, u_y, accuracy;
};

TEST(Ancf, StaticCantileverHasTheCheckedDeflection) {
  const std::map<std::string, TipDeflection> table = {{"1", {-0.36224472989050, -0.99414475872497, 1e-12}},
                                                      {"2", {-0.48892630834, -1.17522286506, 1e-11}},
                                                      {"4", {-0.50742871512, -1.20553370223, 1e-11}},
                                                      {"8", {-0.50850923650, -1.20719775602, 1e-11}}};
  for (const auto& [elements, tip] : table) {
    SCOPED_TRACE(elements);
    const auto bent = bentCantilever<double>(elements);
    ASSERT_TRUE(bent);
    const auto scene = makeScene<double>("ancf_cantilever", {{"elements", elements}});
    // Round-off: eps times the ratio of axial to bending stiffness, EA L^2 / EI = 5e3, per node.
    const double tolerance = tip.accuracy + 1e-11;
    EXPECT_NEAR(valueOf(scene, "u_x", *bent), tip.u_x, tolerance);
    EXPECT_NEAR(valueOf(scene, "u_y", *bent), tip.u_y, tolerance);
  }
}

// The elements converge to the extensible elastica: halving their length divides the error by at least 8 (measured:
// 12 to 17).
TEST(Ancf, StaticCantileverConvergesToTheElastica) {
  const double exact = -1.207239854550;
  double last = 0;
  for (const char* elements : {"2", "4", "8", "16"}) {
    const auto bent = bentCantilever<double>(elements);
    ASSERT_TRUE(bent);
    const auto scene = makeScene<double>("ancf_cantilever", {{"elements", elements}});
    const double error = std::abs(valueOf(scene, "u_y", *bent) - exact);
    if (last > 0) {
      EXPECT_LT(error, last / 8) << elements;
    }
    last = error;
  }
}

TEST(Ancf, FiftyDigitEquilibriumLeavesNoResidual) {
  const auto bent = bentCantilever<BigFloat>("2");
  ASSERT_TRUE(bent);
  const auto scene = makeScene<BigFloat>("ancf_cantilever");
  const auto system = scene.system({Formulation::kIndex3});
  const auto r = residualAt<BigFloat, BigFloat>(*system, Level::kPosition, 0, pointVector(*bent));
  EXPECT_LT(r.lpNorm<Eigen::Infinity>(), BigFloat(1e-40) * 2.07e9);  // of EA
}

// Forces are the gradient of the energy: at rest with a = 0, r_u = -dE/du.
TEST(Ancf, ForcesAreTheGradientOfTheEnergy) {
  for (const char* id : {"ancf_cantilever", "ancf_pendulum"}) {
    const auto scene = makeScene<BigFloat>(id);
    const auto nominal = makeScene<double>(id);
    const Sizes n = scene.sizes();
    State<BigFloat> s = scene.start;
    s.v.setZero();
    s.w.setZero();
    s.u = perturbedPoint(nominal, n).head(n.nu).cast<BigFloat>();
    const auto system = scene.system({Formulation::kIndex3});
    const auto r = residualAt<BigFloat, BigFloat>(*system, Level::kFormulated, 0, pointVector(s));
    const BigFloat size = r.lpNorm<Eigen::Infinity>();
    for (Index i = 0; i < n.nu; ++i) {
      const BigFloat delta = 1e-15;
      State<BigFloat> above = s, below = s;
      above.u[i] += delta;
      below.u[i] -= delta;
      const BigFloat slope = (valueOf(scene, "energy", above) - valueOf(scene, "energy", below)) / (2 * delta);
      // Central differences have the error delta^2 times the ratio of third to first derivative, below 1e5 here.
      EXPECT_LT(abs(r[i] + slope), size * 1e-25) << id << " " << i;
    }
  }
}

// The kinetic energy v M v / 2 has the residual's M: its time derivative is v.M a.
TEST(Ancf, KineticEnergyBelongsToTheMassMatrix) {
  const auto scene = makeScene<BigFloat>("ancf_pendulum");
  const Sizes n = scene.sizes();
  const auto system = scene.system({Formulation::kIndex3});
  State<BigFloat> s = scene.start, rest = scene.start;
  for (Index i = 0; i < n.nu; ++i) s.v[i] = BigFloat(static_cast<double>(i % 5) - 1.5);
  rest.v.setZero();
  rest.w.setZero();
  s.w = s.v;  // a = v
  const auto zero = residualAt<BigFloat, BigFloat>(*system, Level::kFormulated, 0, pointVector(rest));
  const auto r = residualAt<BigFloat, BigFloat>(*system, Level::kFormulated, 0, pointVector(s));
  const BigFloat kinetic = s.v.dot(zero - r) / 2;
  const BigFloat energy = valueOf(scene, "energy", s) - valueOf(scene, "energy", rest);
  EXPECT_LT(abs(kinetic - energy), abs(energy) * 1e-45);
}

}  // namespace
}  // namespace irk::test
