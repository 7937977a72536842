// The embedded estimate against the formulas of HW II (IV.8) for y' = f(t, y).
#include "core/estimates/embedded.h"

#include <gtest/gtest.h>

#include <limits>

#include <Eigen/LU>

#include "tests/core/one_step.h"

namespace irk::test {
namespace {

/// The second-order oscillators as a first-order system, x = (u, v).
struct FirstOrderOscillators {
  Sizes sizes() const { return {.nu = 0, .nx = 4, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    const T c = cos(p.x[0] - p.x[1]), s = sin(p.x[0] - p.x[1]);
    r.x[0] = p.x[2] - p.k[0];
    r.x[1] = p.x[3] - p.k[1];
    r.x[2] = -2.0 * p.k[2] - c * p.k[3] - s * p.x[3] * p.x[3] - 19.62 * sin(p.x[0]);
    r.x[3] = -c * p.k[2] - p.k[3] + s * p.x[2] * p.x[2] - 9.81 * sin(p.x[1]);
  }
};

// A start at t > 0: at t = 0 every other derivative of the solution is zero.
State<double> movingRiccati() { return startOf(Riccati{}, {.t = 0.7, .x = {1.5 + std::sin(0.7)}}); }

/// One step from `start`, and the estimate of its error.
template <class P>
struct EstimatedStep : OneStep<P> {
  EstimatedStep(const P& problem, const State<double>& start, const std::string& method, double h,
                StageSolverKind solver = StageSolverKind::kSchur)
      : OneStep<P>(problem, method, with(solver), {0, 1e-12, NormKind::kAbsolute}) {
    EXPECT_EQ(this->solve(start, h), Outcome::kSuccess);
  }
  static IntegratorOptions with(StageSolverKind solver) {
    IntegratorOptions o = adaptive(1e-12);
    o.solver = solver;
    return o;
  }
  double error(bool again = false) {
    const double again_above = again ? 1 : std::numeric_limits<double>::infinity();
    const auto result = this->estimate.evaluate(this->from, this->stepper.stages(), again_above);
    EXPECT_EQ(result.outcome, Outcome::kSuccess);
    return result.error;
  }
};

// The system of a real eigenvalue is also one of the stages' systems, so the estimate reuses its factors. If the
// stages are coupled, or all eigenvalues are complex, the estimate factorizes its own; the numbers are the same.
TEST(Embedded, SharesTheStagesFactorsWhereTheyHaveThem) {
  for (const char* method : {"radau_iia_3", "radau_iia_5", "radau_iia_4"}) {
    EstimatedStep own(CartesianPendulum{}, pendulumStart<double>(), method, 0.05, StageSolverKind::kCoupledDense);
    const double expected = own.error(true);
    EXPECT_GT(expected, 1);
    for (const auto solver : {StageSolverKind::kSchur, StageSolverKind::kEigen}) {
      SCOPED_TRACE(std::string(method) + " " + std::string(idOf(solver)));
      EstimatedStep shared(CartesianPendulum{}, pendulumStart<double>(), method, 0.05, solver);
      const Counters before = shared.counters;
      EXPECT_NEAR(shared.error(true), expected, 1e-7 * expected);
      const bool odd = std::string(method) != "radau_iia_4";
      EXPECT_EQ(shared.counters.filter_factorizations, odd ? 0 : 1);
      EXPECT_EQ(shared.counters.filter_solves, 2) << "filtered a second time";
      EXPECT_EQ(shared.counters.factorizations, before.factorizations);
      EXPECT_EQ(shared.counters.solves, before.solves);
    }
  }
}

// y1^ = y0 + h (mu f0 + sum b^_i k_i) with sum b^_i c_i^(k-1) = 1/k - mu delta_k1, k = 1..s, and
// err = (1 - h mu J)^-1 (y1^ - y1). If c_1 = 0: k = 1..s - 1 and b^_1 = b_1.
double hairerWanner(const Scheme<double>& scheme, const Mat<double>& k, double mu, double f0, double J, double h) {
  const Index s = scheme.s;
  Mat<double> powers(s, s);
  Vec<double> right(s);
  for (Index i = 0; i < s; ++i) {
    powers.row(i) = scheme.c.transpose().array().pow(static_cast<double>(i));
    right[i] = 1.0 / static_cast<double>(i + 1) - (i == 0 ? mu : 0);
  }
  if (scheme.c[0] == 0) {
    powers.row(s - 1) = Vec<double>::Unit(s, 0).transpose();
    right[s - 1] = scheme.b[0];
  }
  const Vec<double> b_hat = powers.fullPivLu().solve(right);
  const double difference = h * (mu * f0 + (k.row(0) * (b_hat - scheme.b))(0, 0));
  return std::abs(difference / (1 - h * mu * J));
}

TEST(EmbeddedEstimate, IsHairerAndWannersForAnOrdinaryEquation) {
  for (const char* method : {"radau_iia_2", "radau_iia_3", "radau_iia_5", "gauss_3", "gauss_4", "lobatto_iiic_3",
                             "lobatto_iiid_4", "radau_ia_3"}) {
    for (const double h : {0.5, 0.05}) {
      EstimatedStep step(Riccati{}, movingRiccati(), method, h);
      const double f0 = std::cos(0.7), J = -2 * (1.5 + std::sin(0.7));  // f and df/dy = -2 y
      const double expected = hairerWanner(step.scheme, step.stepper.stages().W, step.estimate.mu(), f0, J, h);
      EXPECT_NEAR(step.error() * 1e-12, expected, 1e-6 * expected + 1e-15) << method << " " << h;
    }
  }
}

TEST(EmbeddedEstimate, WeightIsTheRealEigenvalueOfRadauIIA) {
  // HW II (IV.8): gamma0 of RADAU5 is 3.637834252744496, of order 9 and 13 6.286704751729276 and
  // 8.936832788405216.
  const auto weight = [](const char* method) { return EmbeddedEstimate<double>::weight(makeTableau<double>(method)); };
  // Bauer and Fike: an eigenvalue of A, with |A| about 1, has an error of at most eps times the condition of the
  // eigenvectors (9, 95, 1170; irk tableau check); its inverse that times its square. The factor 4 is for the QR
  // steps.
  const auto expect = [&](const char* method, double inverse, double condition) {
    const double bound = 4 * std::numeric_limits<double>::epsilon() * condition * inverse * inverse;
    EXPECT_NEAR(1 / weight(method), inverse, bound) << method;
  };
  expect("radau_iia_3", 3.637834252744496, 9);
  expect("radau_iia_5", 6.286704751729276, 95);
  expect("radau_iia_7", 8.936832788405216, 1170);
}

// Both forms linearize at the start of the step. They differ only in the error of u, which the second-order form
// passes through the residual itself, so they agree up to its square.
TEST(EmbeddedEstimate, SecondOrderSystemsHaveTheEstimateOfTheirFirstOrderForm) {
  const auto start = integrate<double>(Oscillators{}, oscillatorsStart<double>(), 0.1,
                                       makeTableau<double>("radau_iia_5"), fixedSteps(0.01))
                         .state;  // moving, with its accelerations
  State<double> first(FirstOrderOscillators{}.sizes());
  first.x << start.u, start.v;
  first.w << start.v, start.w;
  for (const char* method : {"radau_iia_3", "gauss_4", "lobatto_iiic_3"}) {
    for (const bool again : {false, true}) {
      EstimatedStep second(Oscillators{}, start, method, 0.02);
      EstimatedStep reference(FirstOrderOscillators{}, first, method, 0.02);
      EXPECT_GT(reference.error(again), 1);  // else it is not filtered again
      EXPECT_NEAR(second.error(again) / reference.error(again), 1, 1e-3) << method << again;
    }
  }
}

TEST(EmbeddedEstimate, HasOrderS) {
  const auto start = movingRiccati();
  for (const char* method : {"radau_iia_2", "radau_iia_3", "radau_iia_5", "gauss_3", "lobatto_iiic_3", "radau_ia_4"}) {
    const auto errorOf = [&](double h) { return EstimatedStep(Riccati{}, start, method, h).error(); };
    const auto tableau = makeTableau<double>(method);
    const double order = static_cast<double>(tableau.stages()) - (tableau.c[0] == 0 ? 1 : 0);
    EXPECT_NEAR(orderOf({0.08, 0.06, 0.04, 0.03}, errorOf), order + 1, 0.3) << method;
    EXPECT_EQ(EmbeddedEstimate<double>::order(tableau), order) << method;
  }
}

// A polynomial through a stage at the start would have no defect there.
TEST(EmbeddedEstimate, SeesAnInputAlsoWithAStageAtTheStart) {
  const FirstOrder input{[](const auto& p) {
    using std::cos;
    return cos(20.0 * p.t);
  }};
  for (const char* method : {"radau_iia_3", "gauss_3", "radau_ia_3", "lobatto_iiic_3", "lobatto_iiid_3"}) {
    EstimatedStep step(input, State<double>(input.sizes()), method, 0.3);
    EXPECT_GT(step.error() * 1e-12, std::abs(step.to.x[0] - std::sin(6.0) / 20)) << method;
  }
}

TEST(EmbeddedEstimate, RefusesASingularA) {
  EXPECT_THROW(Integrator<double>(makeSystem<double>(Riccati{}), makeTableau<double>("lobatto_iiia_3"), embedded(1e-6)),
               Misuse);
}

// Radau IA with one stage has c = 0 and a = 1: neither the method nor its estimate sees a force that grows from 0.
TEST(EmbeddedEstimate, RefusesStageOrderZero) {
  const auto o = embedded(1e-6);
  EXPECT_THROW(Integrator<double>(makeSystem<double>(Riccati{}), makeTableau<double>("radau_ia_1"), o), Misuse);
  EXPECT_NO_THROW(Integrator<double>(makeSystem<double>(Riccati{}), makeTableau<double>("radau_ia_2"), o));
}

TEST(EmbeddedEstimate, ControlsTheErrorOfRuns) {
  for (const char* method : {"radau_iia_3", "radau_iia_4", "gauss_3", "lobatto_iiic_4"}) {
    for (const double tol : {1e-4, 1e-7, 1e-10}) {
      const auto s =
          integrate<double>(Riccati{}, riccatiStart<double>(), 5, makeTableau<double>(method), embedded(tol));
      ASSERT_EQ(s.outcome, Outcome::kSuccess) << s.detail;
      EXPECT_LT(std::abs(s.state.x[0] - (1.5 + std::sin(5.0))), 20 * tol) << method << " " << tol;
    }
  }
}

// HW II (IV.8.20): in the first step and after rejections the estimate is filtered twice. In a step over the
// transient, the estimate filtered once is about the deviation of the start, 20 tolerances,
// although the error of the step is much smaller.
TEST(EmbeddedEstimate, OfAFirstStepOverATransientRejectsNothing) {
  // A deviation of the start from cos t decays at once.
  const FirstOrder relaxing{[](const auto& p) {
    using std::cos;
    return -1e6 * (p.x[0] - cos(p.t));
  }};
  for (const char* method : {"radau_iia_3", "radau_iia_5"}) {
    IntegratorOptions o = embedded(1e-4);
    o.step.h = 0.1;
    const auto start = startOf(relaxing, {.x = {1 + 4e-3}});
    const auto s = integrate<double>(relaxing, start, 0.1, makeTableau<double>(method), o);
    ASSERT_EQ(s.outcome, Outcome::kSuccess) << s.detail;
    EXPECT_EQ(s.counters.steps_accepted, 1) << method;
    EXPECT_EQ(s.counters.steps_rejected_error, 0) << method;
    EXPECT_NEAR(s.state.x[0], std::cos(0.1), 1e-5) << method;
  }
}

}  // namespace
}  // namespace irk::test
