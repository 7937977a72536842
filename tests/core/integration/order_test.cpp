// Observed orders with two-sided bounds, on problems that damaged tableaus fail.
#include <gtest/gtest.h>

#include "irk/multiprecision.h"
#include "tests/core/support.h"

namespace irk::test {
namespace {

// In 50 digits every slope has an asymptotic range; in double it disappears in round-off from order 8 on.
double riccatiOrder(const Tableau<BigFloat>& tableau, const std::vector<double>& steps) {
  return orderOf(steps, [&](double h) {
    const auto s = integrate<BigFloat>(Riccati{}, riccatiStart<BigFloat>(), 2, tableau, fixedSteps(h));
    EXPECT_EQ(s.outcome, Outcome::kSuccess) << tableau.id << ": " << s.detail;
    return std::abs(static_cast<double>(BigFloat(s.state.x[0] - (BigFloat(1.5) + sin(BigFloat(2))))));
  });
}

TEST(Order, EveryFamilyShowsItsClassicalOrderOnRiccati) {
  for (const auto& family : familyCatalogue()) {
    for (Index s = family.min_stages; s <= 4; ++s) {
      const auto tableau = makeTableau<BigFloat>(family.id + "_" + std::to_string(s));
      EXPECT_NEAR(riccatiOrder(tableau, {2.0 / 40, 2.0 / 56, 2.0 / 80}), tableau.order, 0.2) << tableau.id;
    }
  }
}

TEST(Order, TwentyAndNineteenAtTenStages) {
  EXPECT_NEAR(riccatiOrder(makeTableau<BigFloat>("gauss_10"), {2.0 / 10, 2.0 / 14, 2.0 / 20}), 20, 0.3);
  EXPECT_NEAR(riccatiOrder(makeTableau<BigFloat>("radau_iia_10"), {2.0 / 10, 2.0 / 14, 2.0 / 20}), 19, 0.3);
}

/// x' = z, 0 = x - sin t has index 2, but z is no multiplier of a position constraint.
struct PrescribedPath {
  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 1, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sin;
    r.x[0] = p.z[0] - p.k[0];
    r.z[0] = p.x[0] - sin(p.t);
  }
};

TEST(Order, UnknownsThatDoNotFollowAtTheEndStayThoseOfTheStages) {
  State<double> start(PrescribedPath{}.sizes());
  start.w << 1, 1;
  const auto end = [&](Multipliers multipliers) {
    auto options = fixedSteps(0.1);
    options.multipliers = multipliers;
    const auto run = integrate<double>(PrescribedPath{}, start, 1, makeTableau<double>("radau_iia_3"), options);
    EXPECT_EQ(run.outcome, Outcome::kSuccess) << run.detail;
    return run;
  };
  const auto stages = end(Multipliers::kStages), kept = end(Multipliers::kConsistent);
  EXPECT_NEAR(kept.state.w[1], std::cos(1.0), 1e-4);
  EXPECT_EQ(kept.state.w, stages.state.w);
  EXPECT_EQ(stages.detail, "");
  EXPECT_EQ(kept.detail, "z is that of the stages, (u, v, x) do not determine it: dr/d(a, k, z) is singular at t = 1");
}

/// y' = t^(d-1) applies the method's quadrature.
struct Monomial {
  int degree;
  Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    T f(1.0);
    for (int i = 1; i < degree; ++i) f = f * p.t;
    r.x[0] = f - p.k[0];
  }
};

TEST(Order, PolynomialsUpToTheOrderAreExactInOneStepOfOne) {
  for (const char* method : {"gauss_3", "lobatto_iiia_3"}) {
    const auto tableau = makeTableau<double>(method);
    for (int degree = 1; degree <= tableau.order + 1; ++degree) {
      const auto s = integrate<double>(Monomial{degree}, State<double>({.nx = 1}), 1, tableau, fixedSteps(1));
      ASSERT_EQ(s.outcome, Outcome::kSuccess);
      const double error = std::abs(s.state.x[0] - 1.0 / degree);
      EXPECT_EQ(error < 1e-14, degree <= tableau.order) << method << " degree " << degree << ": " << error;
    }
  }
}

}  // namespace
}  // namespace irk::test
