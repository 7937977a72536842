// Observed orders with two-sided bounds, on problems that damaged tableaus fail.
#include <gtest/gtest.h>
#include <Eigen/LU>

#include "irk/multiprecision.h"
#include "tests/core/support.h"

namespace irk::test {
namespace {

// In 50 digits every slope has an asymptotic range; in double it disappears in round-off from order 8 on.
double riccatiOrder(const Tableau<BigFloat>& tableau, const std::vector<int>& counts) {
  std::vector<double> h, error;
  for (const int n : counts) {
    h.push_back(2.0 / n);
    const auto s = integrate<BigFloat>(Riccati{}, riccatiStart<BigFloat>(), 2, tableau, fixedSteps(2.0 / n));
    EXPECT_EQ(s.outcome, Outcome::kSuccess) << tableau.id << ": " << s.detail;
    const BigFloat exact = BigFloat(1.5) + sin(BigFloat(2));
    error.push_back(std::abs(static_cast<double>(BigFloat(s.state.x[0] - exact))));
  }
  return slope(h, error);
}

TEST(Order, EveryFamilyShowsItsClassicalOrderOnRiccati) {
  for (const auto& family : familyCatalogue()) {
    for (Index s = family.min_stages; s <= 4; ++s) {
      const auto tableau = makeTableau<BigFloat>(family.id + "_" + std::to_string(s));
      EXPECT_NEAR(riccatiOrder(tableau, {40, 56, 80}), tableau.order, 0.2) << tableau.id;
    }
  }
}

TEST(Order, TwentyAndNineteenAtTenStages) {
  EXPECT_NEAR(riccatiOrder(makeTableau<BigFloat>("gauss_10"), {10, 14, 20}), 20, 0.3);
  EXPECT_NEAR(riccatiOrder(makeTableau<BigFloat>("radau_iia_10"), {10, 14, 20}), 19, 0.3);
}

// Only a nonlinear non-autonomous problem detects all five damaged tableaus.
TEST(Order, DamagedTableausLoseTheirOrder) {
  const auto good = makeTableau<BigFloat>("radau_iia_3");
  EXPECT_NEAR(riccatiOrder(good, {40, 80}), 5, 0.2);
  auto node = good;
  node.c[0] += BigFloat(1e-3);
  auto swapped = good;
  std::swap(swapped.c[0], swapped.c[1]);
  auto transposed = good;
  transposed.A = Mat<BigFloat>(good.A.transpose());
  auto shifted = good;
  shifted.A(0, 0) += BigFloat(1e-3);
  shifted.A(0, 1) -= BigFloat(1e-3);
  auto similar = good;  // P^-1 A P with P 1 = 1 and b^T P = b^T: the same stability function
  Mat<BigFloat> P = Mat<BigFloat>::Identity(3, 3);
  const Vec<BigFloat> along = (Vec<BigFloat>(3) << BigFloat(1), BigFloat(-1), BigFloat(0)).finished();
  Vec<BigFloat> left = (Vec<BigFloat>(3) << good.b[1], -good.b[0], BigFloat(0)).finished();  // b^T left = 0
  P += BigFloat(1e-2) * left * along.transpose();                                            // along^T 1 = 0
  similar.A = P.fullPivLu().solve(Mat<BigFloat>(good.A * P));
  for (const auto& damaged : {node, swapped, transposed, shifted, similar}) {
    EXPECT_LT(riccatiOrder(damaged, {40, 80}), 4.5);
  }
}

struct PendulumOrders {
  double q, v, lambda;
};
PendulumOrders pendulumOrders(int s, Multipliers multipliers, const State<BigFloat>& exact) {
  std::vector<double> h, q, v, lambda;
  for (const int n : {32, 45, 64}) {
    h.push_back(0.5 / n);
    auto options = fixedSteps(0.5 / n);
    options.multipliers = multipliers;
    const auto run = integrate<BigFloat>(CartesianPendulum{}, pendulumStart<BigFloat>(), 0.5,
                                         makeTableau<BigFloat>("radau_iia_" + std::to_string(s)), options);
    EXPECT_EQ(run.outcome, Outcome::kSuccess) << run.detail;
    const auto distance = [](const auto& a, const auto& b) { return static_cast<double>(BigFloat((a - b).norm())); };
    q.push_back(distance(run.state.u, exact.u));
    v.push_back(distance(run.state.v, exact.v));
    lambda.push_back(distance(run.state.z(), exact.z()));
  }
  return {slope(h, q), slope(h, v), slope(h, lambda)};
}

// tableaus/README.md, pendulum in index 2: the orders of Radau IIA are 2s - 1 for q and v, s for lambda. A lambda
// that is solved from q and v at the end has their order.
TEST(Order, RadauIiaOnTheIndexTwoPendulum) {
  auto options = fixedSteps(0.5 / 12);
  options.multipliers = Multipliers::kConsistent;
  const auto reference = integrate<BigFloat>(CartesianPendulum{}, pendulumStart<BigFloat>(), 0.5,
                                             makeTableau<BigFloat>("radau_iia_12"), options);
  ASSERT_EQ(reference.outcome, Outcome::kSuccess);
  for (int s = 1; s <= 4; ++s) {
    for (const auto multipliers : {Multipliers::kStages, Multipliers::kConsistent}) {
      const auto orders = pendulumOrders(s, multipliers, reference.state);
      EXPECT_NEAR(orders.q, 2 * s - 1, 0.25) << s;
      EXPECT_NEAR(orders.v, 2 * s - 1, 0.25) << s;
      EXPECT_NEAR(orders.lambda, multipliers == Multipliers::kStages ? s : 2 * s - 1, 0.25) << s;
    }
  }
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
  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    T f(1.0);
    for (int i = 1; i < degree; ++i) f = f * p.t;
    r.x[0] = f - p.k[0];
  }
};

TEST(Order, PolynomialsUpToTheOrderAreExactInOneStepOfOne) {
  for (const auto& family : familyCatalogue()) {
    const auto tableau = makeTableau<double>(family.id + "_3");
    for (int degree = 1; degree <= tableau.order + 1; ++degree) {
      const State<double> start(Sizes{.nu = 0, .nx = 1, .nz = 0, .constraints = 0});
      const auto s = integrate<double>(Monomial{degree}, start, 1, tableau, fixedSteps(1));
      ASSERT_EQ(s.outcome, Outcome::kSuccess);
      const double error = std::abs(s.state.x[0] - 1.0 / degree);
      if (degree <= tableau.order) {
        EXPECT_LT(error, 1e-14) << tableau.id << " degree " << degree;
      } else {
        EXPECT_GT(error, 1e-6) << tableau.id << " degree " << degree;
      }
    }
  }
}

}  // namespace
}  // namespace irk::test
