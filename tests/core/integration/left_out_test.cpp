// Constraints that follow from the others are found at the start and left out; what they said is checked at each step.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "irk/dependent_constraints.h"
#include "tests/core/support.h"
#include "tests/refusal.h"

namespace irk::test {
namespace {

/// A platform (x, y, theta) that hangs on three parallel rods, at -1, 0 and 1 along it: it swings as a pendulum of the
/// rods' length, and two rods determine this motion. The third may be longer, and then ends farther up.
struct Platform {
  double third = 1;  ///< its length over that of the others
  Sizes sizes() const { return {.nu = 3, .nz = 3, .constraints = 3}; }
  static double angle() { return -1.2; }

  template <class T>
  struct Span {
    T x, y;
  };
  template <class U>
  auto spanOf(const U& u, Index i) const {
    using std::cos;
    using std::sin;
    using T = std::decay_t<decltype(u[0])>;
    const double s = static_cast<double>(i - 1);
    const double more = i == 2 ? third - 1 : 0;
    return Span<T>{u[0] + s * cos(u[2]) - s + more * cos(angle()), u[1] + s * sin(u[2]) + more * sin(angle())};
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    r.u[0] = -2 * p.a[0];
    r.u[1] = -2 * p.a[1] - 2 * 9.81;
    r.u[2] = -0.7 * p.a[2];
    for (Index i = 0; i < 3; ++i) {
      const auto span = spanOf(p.u, i);
      const double s = static_cast<double>(i - 1);
      r.u[0] -= span.x * p.z[i];
      r.u[1] -= span.y * p.z[i];
      r.u[2] -= s * (span.y * cos(p.u[2]) - span.x * sin(p.u[2])) * p.z[i];
    }
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    for (Index i = 0; i < 3; ++i) {
      const auto span = spanOf(u, i);
      const double length = i == 2 ? third : 1;
      g[i] = (span.x * span.x + span.y * span.y - length * length) * 0.5;
    }
  }
  State<double> start() const { return startOf(sizes(), {.u = {std::cos(angle()), std::sin(angle()), 0}}); }
};

std::vector<Index> leftOutOf(const Platform& platform) {
  return dependentConstraints(*makeSystem<double>(platform), platform.start());
}

Solution<double> swing(const Platform& platform, const SystemOptions& options, double tolerance = 1e-9) {
  Integrator<double> integrator(makeSystem<double>(platform, options), makeTableau<double>("radau_iia_5"),
                                adaptive(tolerance));
  return integrator.integrate(platform.start(), 2);
}

constexpr Formulation kFormulations[] = {Formulation::kIndex3,           Formulation::kIndex2, Formulation::kGgl,
                                         Formulation::kIndex2Projected,  Formulation::kIndex1, Formulation::kFirstOrder,
                                         Formulation::kFirstOrderPerStep};

TEST(LeftOut, IsOneOfThreeParallelRods) { EXPECT_EQ(leftOutOf({}).size(), 1U); }

TEST(LeftOut, WithoutThatTheStartIsSingular) {
  const auto solution = swing({}, {});
  EXPECT_EQ(solution.outcome, Outcome::kSingular);
  EXPECT_TRUE(contains(solution.detail, "rank 2 of 3"));
}

// The platform does not turn, and its centre moves as a pendulum of length 1 from the same angle.
TEST(LeftOut, GivesTheMotionOfAPendulumInEveryFormulation) {
  const auto start = startOf(CartesianPendulum{}, {.u = {std::cos(Platform::angle()), std::sin(Platform::angle())}});
  const auto pendulum = integrate<double>(CartesianPendulum{}, start, 2, makeTableau<double>("radau_iia_5"),
                                          adaptive(1e-11), Formulation::kGgl);
  for (const Formulation formulation : kFormulations) {
    const auto solution = swing({}, {.formulation = formulation, .left_out = leftOutOf({})});
    ASSERT_EQ(solution.outcome, Outcome::kSuccess) << idOf(formulation) << ": " << solution.detail;
    EXPECT_NEAR(solution.state.u[0], pendulum.state.u[0], 1e-6) << idOf(formulation);
    EXPECT_NEAR(solution.state.u[1], pendulum.state.u[1], 1e-6) << idOf(formulation);
    EXPECT_NEAR(solution.state.u[2], 0, 1e-6) << idOf(formulation);
    EXPECT_EQ(solution.state.z()[leftOutOf({}).front()], 0) << idOf(formulation);
    EXPECT_GT(solution.state.z().cwiseAbs().maxCoeff(), 1) << idOf(formulation);  // the others carry the weight
  }
}

// The third rod is twice as long and has the direction of the others at the start only: it stops the motion, and a
// system without it moves on.
TEST(LeftOut, EndsTheRunWhereItDoesNotFollowFromTheOthers) {
  const Platform longer{2};
  const auto left_out = leftOutOf(longer);
  ASSERT_EQ(left_out.size(), 1U);
  for (const Formulation formulation : kFormulations) {
    const auto solution = swing(longer, {.formulation = formulation, .left_out = left_out});
    EXPECT_EQ(solution.outcome, Outcome::kDrift) << idOf(formulation);
    EXPECT_LT(solution.state.t, 1) << idOf(formulation);
    EXPECT_TRUE(contains(solution.detail, "left out at the start"));
  }
}

/// A platform on three rods that somebody has set up wrongly.
struct Damaged {
  const char* what;
  std::function<void(Platform&, State<double>&, SystemOptions&)> damage;
  Outcome outcome;
  const char* text;
};

TEST(LeftOut, ADamagedMechanismEndsByName) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Damaged> cases = {
      {"moved aside", [](auto&, auto& s, auto&) { s.u[0] += 0.01; }, Outcome::kInconsistentStart, "g["},
      {"turned", [](auto&, auto& s, auto&) { s.u[2] = 0.1; }, Outcome::kInconsistentStart, "g["},
      {"along the rods", [](auto&, auto& s, auto&) { s.v[1] = 1; }, Outcome::kInconsistentStart, "dg/dt"},
      {"turning", [](auto&, auto& s, auto&) { s.v[2] = 1; }, Outcome::kInconsistentStart, "dg/dt"},
      {"no position", [=](auto&, auto& s, auto&) { s.u[1] = nan; }, Outcome::kNotFinite, "u[1]"},
      {"no velocity", [=](auto&, auto& s, auto&) { s.v[0] = nan; }, Outcome::kNotFinite, "v[0]"},
      {"none left out", [](auto&, auto&, auto& o) { o.left_out = {}; }, Outcome::kSingular, "rank 2 of 3"},
      {"two left out",
       [](auto&, auto&, auto& o) {
         o.left_out = {0, 1};
       },
       Outcome::kDrift, "left out at the start"},
      {"the third is short", [](auto& p, auto&, auto&) { p.third = 0.5; }, Outcome::kDrift, "left out at the start"},
      {"the third has no length", [](auto& p, auto&, auto&) { p.third = 0; }, Outcome::kDrift,
       "left out at the start"}};
  for (const auto& [what, damage, outcome, text] : cases) {
    Platform platform;
    State<double> start = platform.start();
    SystemOptions options{.left_out = leftOutOf(platform)};
    damage(platform, start, options);
    Integrator<double> integrator(makeSystem<double>(platform, options), makeTableau<double>("radau_iia_5"),
                                  adaptive(1e-9));
    const auto solution = integrator.integrate(start, 2);
    EXPECT_EQ(solution.outcome, outcome) << what << ": " << solution.detail;
    EXPECT_TRUE(contains(solution.detail, text)) << what;
  }
}

TEST(LeftOut, NothingWhereAllAreIndependent) {
  EXPECT_TRUE(dependentConstraints(*makeSystem<double>(CartesianPendulum{}), pendulumStart<double>()).empty());
}

TEST(LeftOut, RefusesANumberThatNoConstraintHas) {
  EXPECT_EQ(refusal([] { makeSystem<double>(Platform{}, {.left_out = {3}}); }),
            "left_out: constraint 3: the problem has 3, numbered from 0 on");
}

}  // namespace
}  // namespace irk::test
