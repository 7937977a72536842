// The spatial slider-crank: its time by quadrature, coordinates that agree, constraints, energy.
#include <gtest/gtest.h>

#include "problems/support/gauss_rule.h"
#include "tests/problems/mechanisms/motion.h"

namespace irk::test {
namespace {

constexpr int kPieces = 8;

// From the conservation of energy, E = I(theta) theta'^2 / 2 + V(theta), the time of an angle is
// int sqrt(I / (2 (E - V))) dtheta. I and V are written down here anew from the geometry of the mechanism.
BigFloat timeOf(const BigFloat& theta) {
  const BigFloat r("0.08"), b("0.1"), c("0.12"), L("0.3"), J1("1e-4"), m2("0.5"), m3 = 2, g("9.81");
  const auto inertia = [&](const BigFloat& angle) {
    const BigFloat y = b + r * sin(angle), z = c + r * cos(angle), s = sqrt(L * L - y * y - z * z);
    const BigFloat slope = -(y * r * cos(angle) - z * r * sin(angle)) / s;
    return BigFloat(J1 + m2 / 3 * (r * r + slope * slope) + m3 * slope * slope);
  };
  const auto potential = [&](const BigFloat& angle) { return BigFloat(m2 * g * (c + r * cos(angle)) / 2); };
  const BigFloat speed("6.283185307179586");
  const BigFloat energy = inertia(0) * speed * speed / 2 + potential(0);
  const auto slowness = [&](const BigFloat& angle) {
    return BigFloat(sqrt(inertia(angle) / (2 * (energy - potential(angle)))));
  };
  const GaussRule<BigFloat> rule(30);
  BigFloat sum = 0;
  for (int k = 0; k < kPieces; ++k) {
    sum += rule(slowness, BigFloat(theta * k / kPieces), BigFloat(theta * (k + 1) / kPieces));
  }
  return sum;
}

TEST(SpatialSliderCrank, TakesTheTimeThatItsEnergyGives) {
  for (const char* coordinates : {"natural", "minimal"}) {
    SCOPED_TRACE(coordinates);
    const auto scene = makeScene<BigFloat>("spatial_slider_crank", {{"coordinates", coordinates}});
    const BigFloat t("0.12");
    const auto s = stateAfter<BigFloat>(scene, t, 1e-22, 10);
    EXPECT_GT(s.u[0], 0.5);
    EXPECT_LT(abs(timeOf(s.u[0]) - t), BigFloat("1e-20"));
  }
}

TEST(SpatialSliderCrank, ItsCoordinatesAgreeOverTheWholeTime) {
  const auto natural = makeScene<double>("spatial_slider_crank");
  const auto all = stateAfter<double>(natural, 2.0, 1e-13, 7);
  for (const char* coordinates : {"reduced", "minimal"}) {
    const auto scene = makeScene<double>("spatial_slider_crank", {{"coordinates", coordinates}});
    const auto s = stateAfter<double>(scene, 2.0, 1e-13, 7);
    for (const char* name : {"theta", "theta'", "s", "s'"}) {
      EXPECT_NEAR(valueOf(scene, name, s), valueOf(natural, name, all), 1e-9) << coordinates << " " << name;
    }
  }
}

TEST(SpatialSliderCrank, KeepsItsEnergyAndConstraints) {
  for (const char* coordinates : {"natural", "reduced", "minimal"}) {
    const auto scene = makeScene<double>("spatial_slider_crank", {{"coordinates", coordinates}, {"T", "0.01"}});
    for (const Formulation formulation : {Formulation::kIndex3, Formulation::kIndex2, Formulation::kGgl}) {
      const Drift drift = driftOf(scene, 1e-10, formulation);
      EXPECT_EQ(drift.outcome, Outcome::kSuccess);
      EXPECT_LT(drift.invariants.at("energy"), 1e-8);
      EXPECT_LT(drift.position, 1e-9);
    }
  }
}

// The force of the joint moves the crank: J1 theta'' is its moment. The rod pushes the slider along its path.
TEST(SpatialSliderCrank, ItsForcesAreThoseOfNewton) {
  const auto scene = makeScene<double>("spatial_slider_crank");
  const auto s = stateAfter<double>(scene, 0.3, 1e-11, 5);
  const auto value = [&](const char* name) { return valueOf(scene, name, s); };
  const double along = value("lambda") * (value("Ax") - value("s")) / 0.3;
  EXPECT_NEAR(2 * s.w[4], along - 0.5 * s.w[4] / 3, 1e-9);  // the slider takes a third of the rod with it
  EXPECT_NEAR(1e-4 * s.w[0], 0.08 * (std::cos(s.u[0]) * value("lambda_y") - std::sin(s.u[0]) * value("lambda_z")),
              1e-9);
}

TEST(SpatialSliderCrank, RefusesARodThatIsTooShort) {
  EXPECT_THROW(makeScene<double>("spatial_slider_crank", {{"L", "0.2"}}), Misuse);
}

}  // namespace
}  // namespace irk::test
