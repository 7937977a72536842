// Orders per formulation and component, drift, and the effect of omitted terms of the Jacobian.
#include <gtest/gtest.h>

#include "irk/multiprecision.h"
#include "tests/core/support.h"

namespace irk::test {
namespace {

/// M = diag(1, 2), x^2 + y^2 (1 + 0.3 x) = 1, gyroscopic and nonlinear forces.
struct Mechanical {
  Sizes sizes() const { return {.nu = 2, .nx = 0, .nz = 1, .constraints = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T x = p.u[0], y = p.u[1];
    r.u[0] = -x - p.v[0] * p.v[1] / 5.0 - p.z[0] * (2.0 * x + y * y * 3.0 / 10.0) - p.a[0];
    r.u[1] = -2.0 - y * y * x / 2.0 - p.z[0] * (2.0 * y * (1.0 + x * 3.0 / 10.0)) - 2.0 * p.a[1];
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    g[0] = u[0] * u[0] + u[1] * u[1] * (1.0 + u[0] * 3.0 / 10.0) - 1.0;
  }
};

template <class Real>
State<Real> mechanicalStart() {
  State<Real> s(Mechanical{}.sizes());
  s.u[0] = Real(1);
  s.v[1] = Real(1) / Real(2);
  return s;
}

State<BigFloat> mechanicalEnd(const char* method, double h, Formulation formulation, Multipliers multipliers) {
  IntegratorOptions options = fixedSteps(h);
  options.multipliers = multipliers;
  const auto s = integrate<BigFloat>(Mechanical{}, mechanicalStart<BigFloat>(), 1, makeTableau<BigFloat>(method),
                                     options, formulation);
  EXPECT_EQ(s.outcome, Outcome::kSuccess) << method << ' ' << s.detail;
  return s.state;
}

constexpr double kNotStated = -100;

struct OrderCase {
  const char* method;
  Formulation formulation;
  double q, v, lambda;
  Multipliers multipliers = Multipliers::kStages;
};

// The table "Mechanical systems" of tableaus/README.md. A lambda that is solved from q and v at the end has their
// order.
TEST(Formulation, OrdersPerComponent) {
  const auto reference = mechanicalEnd("radau_iia_10", 1.0 / 12, Formulation::kIndex2, Multipliers::kConsistent);
  const OrderCase cases[] = {{"gauss_2", Formulation::kIndex2, 4, 2, 0},
                             {"gauss_3", Formulation::kIndex2, 6, 4, 2},
                             {"gauss_3", Formulation::kGgl, 4, 4, 2},
                             {"gauss_2", Formulation::kIndex2Projected, 4, 4, kNotStated},
                             {"radau_ia_2", Formulation::kGgl, 2, 2, 1},
                             {"radau_ia_2", Formulation::kIndex2Projected, 3, 3, kNotStated},
                             {"radau_iia_1", Formulation::kIndex2, 1, 1, 1},
                             {"radau_iia_2", Formulation::kIndex2, 3, 3, 2},
                             {"radau_iia_3", Formulation::kIndex2, 5, 5, 3},
                             {"radau_iia_4", Formulation::kIndex2, 7, 7, 4},
                             {"radau_iia_2", Formulation::kIndex2, 3, 3, 3, Multipliers::kConsistent},
                             {"radau_iia_4", Formulation::kIndex2, 7, 7, 7, Multipliers::kConsistent},
                             {"radau_iia_2", Formulation::kGgl, 3, 3, 2},
                             {"radau_iia_2", Formulation::kIndex3, 3, 2, 1},
                             {"radau_iia_2", Formulation::kIndex1, 3, 3, 3},
                             {"lobatto_iiia_3", Formulation::kGgl, 4, 4, 2},
                             {"lobatto_iiic_3", Formulation::kGgl, 4, 4, 2},
                             {"lobatto_iiic_3", Formulation::kIndex3, 4, 2, 1}};
  for (const OrderCase& c : cases) {
    const auto orders = ordersOf({1.0 / 64, 1.0 / 90, 1.0 / 128}, [&](double h) -> std::vector<double> {
      const auto end = mechanicalEnd(c.method, h, c.formulation, c.multipliers);
      const auto distance = [](const auto& a, const auto& b) { return static_cast<double>(BigFloat((a - b).norm())); };
      return {distance(end.u, reference.u), distance(end.v, reference.v), distance(end.z(), reference.z())};
    });
    const auto name = std::string(c.method) + ' ' + std::string(idOf(c.formulation));
    EXPECT_NEAR(orders[0], c.q, 0.25) << name << " q";
    EXPECT_NEAR(orders[1], c.v, 0.25) << name << " v";
    if (c.lambda != kNotStated) {
      EXPECT_NEAR(orders[2], c.lambda, 0.25) << name << " lambda";
    }
  }
}

double drift(const Solution<double>& s) {
  const double x = s.state.u[0], y = s.state.u[1];
  return std::abs(x * x + y * y * (1 + 0.3 * x) - 1);
}

TEST(Formulation, OnlyGglKeepsThePosition) {
  const auto run = [](Formulation formulation) {
    return integrate<double>(Mechanical{}, mechanicalStart<double>(), 1, makeTableau<double>("radau_iia_2"),
                             fixedSteps(0.02), formulation);
  };
  EXPECT_LT(drift(run(Formulation::kGgl)), 1e-14);
  EXPECT_LT(drift(run(Formulation::kIndex3)), 1e-14);
  EXPECT_GT(drift(run(Formulation::kIndex2)), 1e-9);
  EXPECT_GT(drift(run(Formulation::kIndex1)), 1e-9);
}

TEST(Formulation, ProjectionKeepsTheVelocity) {
  const auto system = makeSystem<double>(Mechanical{}, {.formulation = Formulation::kIndex2Projected});
  for (const auto& [formulation, most] :
       {std::pair{Formulation::kIndex2Projected, 1e-14}, std::pair{Formulation::kIndex2, 1e-1}}) {
    const auto s = integrate<double>(Mechanical{}, mechanicalStart<double>(), 1, makeTableau<double>("gauss_2"),
                                     fixedSteps(0.02), formulation);
    Vec<double> r(3);
    system->evaluate(Level::kVelocity, pointOf(s.state), VecView<double>(r.data(), 3));
    EXPECT_LT(std::abs(r[2]), most);
    if (formulation == Formulation::kIndex2) {
      EXPECT_GT(std::abs(r[2]), 1e-9);
    }
  }
}

std::vector<std::int64_t> counted(const Solution<double>& s) {
  std::vector<std::int64_t> all;
  s.counters.forEach([&](std::string_view, std::int64_t value) { all.push_back(value); });
  return all;
}

// With a constant M its derivatives vanish, so no iteration may change. (`no_mass_vxz` differentiates in two
// passes, so evaluations over dual numbers are not compared.)
TEST(JacobianTerms, ChangeNothingWithConstantMass) {
  IntegratorOptions options = adaptive(1e-8);
  const auto run = [&](JacobianTerms terms) {
    options.jacobian = terms;
    auto s = integrate<double>(Mechanical{}, mechanicalStart<double>(), 1, makeTableau<double>("radau_iia_3"), options);
    EXPECT_EQ(s.outcome, Outcome::kSuccess) << s.detail;
    s.counters.dual_residuals = 0;
    return s;
  };
  const auto full = run(JacobianTerms::kFull);
  for (const auto terms : {JacobianTerms::kNoMassVxz, JacobianTerms::kNoMass, JacobianTerms::kNoConstraintXz}) {
    const auto s = run(terms);
    EXPECT_EQ(counted(s), counted(full)) << idOf(terms);
    EXPECT_EQ(s.state.u, full.state.u) << idOf(terms);
  }
}

TEST(JacobianPoint, EachStageConvergesFasterAndNeedsACoupledSolver) {
  IntegratorOptions options = fixedSteps(0.1);
  const auto tableau = makeTableau<double>("radau_iia_3");
  const auto iterations = [&](JacobianPoint point) {
    options.jacobian_point = point;
    options.solver = StageSolverKind::kCoupledDense;
    const auto s = integrate<double>(Oscillators{}, oscillatorsStart<double>(), 2, tableau, options);
    EXPECT_EQ(s.outcome, Outcome::kSuccess) << s.detail;
    return s.counters.newton_iterations;
  };
  EXPECT_LT(iterations(JacobianPoint::kEachStage), iterations(JacobianPoint::kStart));
  EXPECT_LT(iterations(JacobianPoint::kPredicted), iterations(JacobianPoint::kStart));
  options.solver = StageSolverKind::kSchur;
  options.jacobian_point = JacobianPoint::kEachStage;
  EXPECT_THROW(static_cast<void>(integrate<double>(Oscillators{}, oscillatorsStart<double>(), 2, tableau, options)),
               Misuse);
}

TEST(Estimate, EveryDoublingKeepsTheTolerance) {
  const auto tableau = makeTableau<double>("radau_iia_3");
  const auto exact = integrate<double>(CartesianPendulum{}, pendulumStart<double>(), 2, tableau, adaptive(1e-13));
  for (const auto estimate : {ErrorEstimate::kDoubling, ErrorEstimate::kRichardson, ErrorEstimate::kDoublingScalar}) {
    IntegratorOptions options = adaptive(1e-7);
    options.step.estimate = estimate;
    const auto s = integrate<double>(CartesianPendulum{}, pendulumStart<double>(), 2, tableau, options);
    ASSERT_EQ(s.outcome, Outcome::kSuccess) << idOf(estimate) << s.detail;
    const double error = (s.state.u - exact.state.u).norm();
    EXPECT_LT(error, 1e-5) << idOf(estimate);
    EXPECT_GT(error, 1e-13) << idOf(estimate);
  }
}

}  // namespace
}  // namespace irk::test
