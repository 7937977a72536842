// In index 3 what Newton's method leaves of velocities along the constraints adds up over the steps.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/support.h"

namespace irk::test {
namespace {

constexpr double kGravity = 9.81;

/// The pendulum of length 1 in Cartesian coordinates.
struct Pendulum {
  Sizes sizes() const { return {.nu = 2, .nz = 1, .constraints = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -p.u[0] * p.z[0] - p.a[0];
    r.u[1] = -p.u[1] * p.z[0] - kGravity - p.a[1];
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& c) const {
    c[0] = 0.5 * (u[0] * u[0] + u[1] * u[1] - 1.0);
  }
};

// Released from the horizontal, its period is 4 K(1/sqrt(2)) / sqrt(g). Three quarters of a period after the start it
// passes its lowest point with v = (sqrt(2 g), 0).
void expectRightAfterManySteps(const char* method, double tol, ErrorEstimate estimate) {
  State<double> start(Pendulum{}.sizes());
  start.u[0] = 1;
  start.w[1] = -kGravity;
  const double period = 4 * std::comp_ellint_1(std::sqrt(0.5)) / std::sqrt(kGravity);
  IntegratorOptions options = adaptive(tol);
  options.step.estimate = estimate;
  const auto s =
      integrate<double>(Pendulum{}, start, 2.75 * period, makeTableau<double>(method), options, Formulation::kIndex3);
  ASSERT_EQ(s.outcome, Outcome::kSuccess) << method << " " << s.detail;
  EXPECT_GT(s.counters.steps_accepted, 2000) << method;
  EXPECT_NEAR(s.state.u[0], 0, 10 * tol) << method;
  EXPECT_NEAR(s.state.v[0], std::sqrt(2 * kGravity), 10 * tol) << method;
}

// Without a look at the velocities both were off by 100 tolerances and more after 30 000 steps, at 1e-10 by 1000.
TEST(Index3, KeepsVelocitiesAlongConstraintsOverManySteps) {
  expectRightAfterManySteps("lobatto_iiic_3", 1e-8, ErrorEstimate::kRichardson);
  expectRightAfterManySteps("radau_iia_2", 1e-8, ErrorEstimate::kRichardson);
}

// Steps were rejected since velocities from loose solves did not fit the next step.
TEST(Index3, EndsWhereVelocitiesWereTooLooseForTheEstimate) {
  expectRightAfterManySteps("radau_iia_2", 1e-6, ErrorEstimate::kEmbedded);
}

}  // namespace
}  // namespace irk::test
