// Every option does what its description says, seen from outside: at which points the residual and
// its derivatives are asked for, which terms are left out, how large the steps become, what is
// counted.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <type_traits>
#include <vector>

#include "core/control/controller.h"
#include "core/derivatives/differentiator.h"
#include "core/estimates/step_attempt.h"
#include "core/stages/error_norm.h"
#include "tests/core/support.h"

namespace irk::test {
namespace {

StepOptions controlled(StepControl control) {
  StepOptions o;
  o.control = control;
  o.s_min = 4;
  o.change_at_least = 2;
  o.growth_at_most = 5;
  return o;
}

// HW II (IV.8.25): h_new = 0.9 h eps^(-1/(p+1)) (h / h_old) (eps_old / eps)^(1/(p+1)), where that
// is less than without the two ratios.
double gustafsson(int p, double error, double h, double error_before, double h_before) {
  const double root = 1.0 / (p + 1);
  const double trend = h / h_before * std::pow(error_before / error, root);
  return 0.9 * h * std::pow(error, -root) * std::min(1.0, trend);
}

TEST(Predictive, FollowsGustafssonWhereStepAndErrorChange) {
  struct Step {
    double error, h;
  };
  // Steps that shrink and grow, errors that fall and grow: each ratio upside down gives another
  // number.
  const Step sequences[][3] = {{{0.5, 0.1}, {0.3, 0.07}, {0.6, 0.09}},
                               {{0.2, 0.1}, {0.7, 0.12}, {0.9, 0.05}},
                               {{0.9, 0.02}, {0.5, 0.015}, {0.8, 0.03}}};
  for (const int p : {1, 3, 5}) {
    for (const auto& steps : sequences) {
      const auto controller = makeController(controlled(StepControl::kPredictive), p);
      (void)controller->decide(steps[0].error, steps[0].h);
      for (int i = 1; i < 3; ++i) {
        const auto decision = controller->decide(steps[i].error, steps[i].h);
        const double wish =
            gustafsson(p, steps[i].error, steps[i].h, steps[i - 1].error, steps[i - 1].h);
        const double ratio = wish / steps[i].h;
        const double expected = ratio >= 1 && ratio <= 1.2 ? steps[i].h : wish;
        EXPECT_TRUE(decision.accept);
        EXPECT_NEAR(decision.h, expected, 1e-12 * expected) << "p = " << p << ", step " << i;
      }
    }
  }
}

// Errors below 1e-2 count as 1e-2 for the trend (ERRACC of RADAU), and a changed order brings its
// own past.
TEST(Predictive, RemembersNoErrorBelowItsFloorAndTakesTheOrdersOwnPast) {
  auto controller = makeController(controlled(StepControl::kPredictive), 3);
  (void)controller->decide(1e-9, 0.1);
  EXPECT_NEAR(controller->decide(0.9, 0.08).h, gustafsson(3, 0.9, 0.08, 1e-2, 0.1), 1e-12);
  controller = makeController(controlled(StepControl::kPredictive), 3);
  (void)controller->decide(0.4, 0.1);
  controller->changeOrder(5, 0.2, 0.05);
  EXPECT_NEAR(controller->decide(0.6, 0.04).h, gustafsson(5, 0.6, 0.04, 0.2, 0.05), 1e-12);
  controller->changeOrder(5, 1e-9, 0.05);
  EXPECT_NEAR(controller->decide(0.6, 0.04).h, gustafsson(5, 0.6, 0.04, 1e-2, 0.05), 1e-12);
  controller->forget();
  EXPECT_NEAR(controller->decide(0.9, 0.04).h, 0.9 * 0.04 * std::pow(0.9, -1.0 / 6), 1e-14)
      << "no trend";
}

TEST(Predictive, AfterNewtonFailedItsStepIsNotTriedAtOnce) {
  const auto controller = makeController(controlled(StepControl::kPredictive), 3);
  EXPECT_NEAR(controller->afterFailure(0.1), 0.05, 1e-15);
  int kept = 0;
  while (kept < 100 && controller->decide(1e-6, 0.05).h == 0.05) ++kept;
  EXPECT_EQ(kept, 9);
  controller->afterFailure(0.1);
  controller->forget();
  EXPECT_GT(controller->decide(1e-6, 0.05).h, 0.1) << "a restart knows of no failure";
}

// The later source: f = (1 / (2 eps))^(1/p), growth only below 1 / 4, no gamma.
TEST(Hotint, HasItsOwnExponentAndSafety) {
  const auto fresh = [](int p) { return makeController(controlled(StepControl::kHotint), p); };
  EXPECT_NEAR(fresh(2)->decide(0.05, 0.1).h, 0.1 * std::sqrt(10.0), 1e-13);
  EXPECT_NEAR(fresh(3)->decide(0.02, 0.1).h, 0.1 * std::cbrt(25.0), 1e-13);
  EXPECT_NEAR(fresh(1)->decide(0.2499, 0.1).h, 0.1 / (2 * 0.2499), 1e-15) << "just below 1 / s_max";
  EXPECT_EQ(fresh(1)->decide(0.25, 0.1).h, 0.1) << "not below 1 / s_max";
  const auto rejected = fresh(2)->decide(8, 0.1);
  EXPECT_FALSE(rejected.accept);
  EXPECT_NEAR(rejected.h, 0.1 / 4, 1e-15);
  // No gamma: the same decision whatever came before.
  const auto controller = fresh(2);
  (void)controller->decide(0.9, 0.2);
  EXPECT_NEAR(controller->decide(0.05, 0.1).h, 0.1 * std::sqrt(10.0), 1e-13);
  controller->changeOrder(3, 0.5, 0.1);
  EXPECT_NEAR(controller->decide(0.02, 0.1).h, 0.1 * std::cbrt(25.0), 1e-13);
}

TEST(Paper, UsesItsOptions) {
  StepOptions o = controlled(StepControl::kPaper);
  o.s_min = 3;
  o.change_at_least = 1.5;
  o.growth_at_most = 2.5;
  const auto fresh = [&] { return makeController(o, 1); };
  EXPECT_NEAR(fresh()->decide(1 / 9.01, 0.1).h, 0.1 * std::sqrt(9.01 / 3), 1e-13);
  EXPECT_EQ(fresh()->decide(1 / 8.99, 0.1).h, 0.1) << "s_max = s_min^2";
  EXPECT_NEAR(fresh()->decide(1e-9, 0.1).h, 0.25, 1e-15);
  EXPECT_NEAR(fresh()->decide(1.01, 0.1).h, 0.1 * std::sqrt(1 / 3.03), 1e-13);
  EXPECT_NEAR(fresh()->afterFailure(0.1), 0.1 / 1.5, 1e-15);
  EXPECT_NEAR(fresh()->decide(1e6, 0.1).h, 0.1 * 0.05, 1e-15);
}

TEST(Paper, ForgetsGammaAtARestartAndAtAnotherOrder) {
  const double plain = 0.05 * std::pow(1 / (4 * 1e-2), 1.0 / 4);  // grows: below 1/16, f = 2.2
  const auto damped = [] {
    auto controller = makeController(controlled(StepControl::kPaper), 3);
    (void)controller->decide(0.5, 0.1);
    (void)controller->decide(0.5 / 8 * 0.95, 0.05);  // gamma = 0.95
    return controller;
  };
  EXPECT_NEAR(damped()->decide(1e-2, 0.05).h, 0.95 * plain, 1e-12);
  const auto restarted = damped();
  restarted->forget();
  EXPECT_NEAR(restarted->decide(1e-2, 0.05).h, plain, 1e-12);
  const auto elsewhere = damped();
  elsewhere->forget();
  EXPECT_NEAR(elsewhere->decide(1e-2, 0.04).h, 0.8 * plain, 1e-12) << "another step: no gamma";
  const auto failed = makeController(controlled(StepControl::kPaper), 3);
  failed->afterFailure(0.1);
  failed->forget();
  EXPECT_NEAR(failed->decide(1e-9, 0.05).h, 0.25, 1e-12) << "a restart knows of no failure";
  const auto changed = damped();
  changed->changeOrder(1, 0.5, 0.05);
  EXPECT_NEAR(changed->decide(1e-2, 0.05).h, 0.05 * 5, 1e-12);  // f = 5
}

struct Taken {
  Solution<double> solution;
  std::vector<double> h, error;
};

template <class P>
Taken taken(const P& problem, const State<double>& start, double t_end,
            const IntegratorOptions& options, const char* method = "radau_iia_3") {
  Integrator<double> integrator(makeSystem<double>(problem), makeTableau<double>(method), options);
  Taken all;
  Monitor<double> monitor;
  monitor.accepted = [&](const StepRecord<double>& s) {
    all.h.push_back(s.h);
    all.error.push_back(s.error);
  };
  all.solution = integrator.integrate(start, t_end, monitor);
  return all;
}

TEST(Steps, AreNeverAboveTheLargest) {
  for (const auto control : {StepControl::kPredictive, StepControl::kPaper, StepControl::kHotint}) {
    for (const auto estimate : {ErrorEstimate::kRichardson, ErrorEstimate::kEmbedded}) {
      IntegratorOptions o = adaptive(1e-3);
      o.step.control = control;
      o.step.estimate = estimate;
      const auto free = taken(Riccati{}, riccatiStart<double>(), 4, o);
      ASSERT_GT(*std::max_element(free.h.begin(), free.h.end()), 0.2);
      for (const double first : {0.0, 3.0}) {
        o.step.h_max = 0.0625;
        o.step.h = first;
        const auto all = taken(Riccati{}, riccatiStart<double>(), 4, o);
        ASSERT_EQ(all.solution.outcome, Outcome::kSuccess);
        const double largest = *std::max_element(all.h.begin(), all.h.end());
        EXPECT_LE(largest, 0.0625 * (1 + 1e-9)) << idOf(control) << " " << idOf(estimate);
        EXPECT_GE(largest, 0.0625 * (1 - 1e-9)) << "and reach it";
        EXPECT_GE(all.h.size(), 64u);
      }
    }
  }
}

TEST(Steps, AreNotBelowTheSmallestButAFailure) {
  IntegratorOptions o = adaptive(1e-10);
  o.step.control = StepControl::kPredictive;
  o.step.estimate = ErrorEstimate::kRichardson;
  const auto free = taken(Riccati{}, riccatiStart<double>(), 2, o);
  ASSERT_EQ(free.solution.outcome, Outcome::kSuccess);
  const double least = *std::min_element(free.h.begin(), free.h.end());
  o.step.h_min = 0.9 * least;
  EXPECT_EQ(taken(Riccati{}, riccatiStart<double>(), 2, o).solution.outcome, Outcome::kSuccess);
  o.step.h_min = 0.3;
  EXPECT_EQ(taken(Riccati{}, riccatiStart<double>(), 2, o).solution.outcome,
            Outcome::kStepTooSmall);
}

TEST(Steps, OfVariableOrderAreNeverAboveTheLargest) {
  IntegratorOptions o = adaptive(1e-7);
  o.step.control = StepControl::kPredictive;
  o.step.estimate = ErrorEstimate::kEmbedded;
  o.order = OrderControl::kVariable;
  for (const double largest : {0.3, 0.1, 0.05}) {
    o.step.h_max = largest;
    Integrator<double> integrator(makeSystem<double>(Riccati{}),
                                  makeMethods<double>("radau_iia_3", 13, 5), o);
    double most = 0;
    Monitor<double> monitor;
    monitor.accepted = [&](const StepRecord<double>& s) { most = std::max(most, s.h); };
    ASSERT_EQ(integrator.integrate(riccatiStart<double>(), 20, monitor).outcome, Outcome::kSuccess);
    EXPECT_LE(most, largest * (1 + 1e-9));
    EXPECT_GE(most, 0.5 * largest);
  }
}

TEST(Steps, AttemptsAreCountedAgainstTheirLimit) {
  IntegratorOptions o = adaptive(1e-7);
  o.step.control = StepControl::kPredictive;
  o.step.estimate = ErrorEstimate::kRichardson;
  const Counters c = taken(Riccati{}, riccatiStart<double>(), 4, o).solution.counters;
  o.step.max_steps = c.steps_accepted + c.steps_rejected_error + c.steps_rejected_newton;
  EXPECT_EQ(taken(Riccati{}, riccatiStart<double>(), 4, o).solution.outcome, Outcome::kSuccess);
  --o.step.max_steps;
  EXPECT_EQ(taken(Riccati{}, riccatiStart<double>(), 4, o).solution.outcome, Outcome::kMaxSteps);
}

TEST(Steps, AcceptedOnesHaveErrorsWithinTheTolerance) {
  for (const auto control : {StepControl::kPredictive, StepControl::kPaper, StepControl::kHotint}) {
    IntegratorOptions o = adaptive(1e-6);
    o.step.control = control;
    o.step.estimate = ErrorEstimate::kRichardson;
    o.step.h = 1;  // too large: rejected
    const auto all = taken(Riccati{}, riccatiStart<double>(), 4, o);
    ASSERT_EQ(all.solution.outcome, Outcome::kSuccess);
    EXPECT_GE(all.solution.counters.steps_rejected_error, 1);
    EXPECT_EQ(all.solution.counters.steps_accepted, static_cast<std::int64_t>(all.h.size()));
    double sum = 0;
    for (std::size_t i = 0; i < all.h.size(); ++i) {
      EXPECT_LE(all.error[i], 1);
      sum += all.h[i];
    }
    EXPECT_NEAR(sum, 4, 1e-12);
  }
}

/// Where the residual was evaluated, over double and over dual numbers. x' = t, u'' = sin u.
struct Asked {
  double t, u, k;
  bool dual;
};
struct Spy {
  std::shared_ptr<std::vector<Asked>> asked = std::make_shared<std::vector<Asked>>();
  Sizes sizes() const { return {.nu = 1, .nx = 1, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sin;
    r.u[0] = -sin(p.u[0]) - p.a[0];
    r.x[0] = p.t - p.k[0];
    if constexpr (std::is_same_v<T, double>) {
      asked->push_back({p.t, p.u[0], p.k[0], false});
    } else if constexpr (std::is_same_v<T, Dual<double>>) {
      asked->push_back({p.t.value, p.u[0].value, p.k[0].value, true});
    }
  }
};

State<double> spyStart() {
  State<double> s(Spy{}.sizes());
  s.u[0] = 0.5;
  s.v[0] = 2;
  return s;
}

std::vector<Asked> askedBy(const IntegratorOptions& options, double t_end, const char* method) {
  const Spy spy;
  Integrator<double> integrator(makeSystem<double>(spy), makeTableau<double>(method), options);
  EXPECT_EQ(integrator.integrate(spyStart(), t_end).outcome, Outcome::kSuccess);
  return *spy.asked;
}

IntegratorOptions oneStep(double h) {
  IntegratorOptions o = fixedSteps(h);
  o.derivatives = DerivativeSource::kAutomatic;
  o.newton.kind = NewtonKind::kSimplified;
  o.newton.keep_jacobian_below = 0.999;
  o.solver = StageSolverKind::kCoupledDense;
  o.predictor = Predictor::kAcceleration;
  return o;
}

TEST(JacobianPointOption, IsWhereTheDerivativesAreAsked) {
  const double h = 0.25, a0 = -std::sin(0.5);
  const auto duals = [&](JacobianPoint point) {
    IntegratorOptions o = oneStep(h);
    o.jacobian_point = point;
    std::vector<Asked> found;
    for (const auto& one : askedBy(o, h, "radau_iia_3")) {
      if (one.dual) found.push_back(one);
    }
    return found;
  };
  const auto last = [&](JacobianPoint point) { return duals(point).back(); };
  EXPECT_EQ(last(JacobianPoint::kStart).t, 0);
  EXPECT_EQ(last(JacobianPoint::kStart).u, 0.5);
  const Asked middle = last(JacobianPoint::kMiddle);
  EXPECT_NEAR(middle.t, h / 2, 1e-15);
  EXPECT_NEAR(middle.u, 0.5 + 2 * h / 2 + a0 * h * h / 8, 1e-14);
  // Radau IIA's stages lie at 0.155, 0.645 and 1: the second one is nearest to 0.6.
  const double c = (4 + std::sqrt(6.0)) / 10;
  const Asked predicted = last(JacobianPoint::kPredicted);
  EXPECT_NEAR(predicted.t, c * h, 1e-15);
  EXPECT_NEAR(predicted.u, 0.5 + 2 * c * h + a0 * c * c * h * h / 2, 1e-14);
  const auto each = duals(JacobianPoint::kEachStage);
  ASSERT_GE(each.size(), 3u);
  const double nodes[] = {(4 - std::sqrt(6.0)) / 10, c, 1};
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(each[each.size() - 3 + i].t, nodes[i] * h, 1e-14);
}

// k of the first residuals of the second step. The first step's stages have k = c_i h, its end k =
// h.
TEST(PredictorOption, IsWhereNewtonStarts) {
  const double h = 0.25;
  const auto second = [&](Predictor predictor) {
    IntegratorOptions o = oneStep(h);
    o.predictor = predictor;
    std::vector<Asked> found;
    for (const auto& one : askedBy(o, 2 * h, "radau_iia_2")) {
      if (!one.dual && one.t > h * (1 + 1e-12)) found.push_back(one);
    }
    found.resize(2);  // the two stages of the first iteration
    return found;
  };
  // A last step that is shorter: 0.4 of the one before.
  IntegratorOptions o = oneStep(h);
  o.predictor = Predictor::kExtrapolated;
  int shorter = 0;
  for (const auto& one : askedBy(o, 1.4 * h, "radau_iia_2")) {
    if (one.dual || one.t <= h * (1 + 1e-12)) continue;
    EXPECT_NEAR(one.k, one.t, 1e-13) << "k = t is extrapolated exactly";
    ++shorter;
  }
  EXPECT_GE(shorter, 2);
  const double c[] = {1.0 / 3, 1};
  const auto previous = second(Predictor::kPrevious);
  const auto constant = second(Predictor::kAcceleration);
  const auto extrapolated = second(Predictor::kExtrapolated);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_NEAR(previous[i].t, h + c[i] * h, 1e-15);
    EXPECT_NEAR(previous[i].k, c[i] * h, 1e-14) << "stage " << i;
    EXPECT_NEAR(constant[i].k, h, 1e-14) << "stage " << i;
    EXPECT_NEAR(extrapolated[i].k, h + c[i] * h, 1e-14) << "stage " << i;
  }
}

/// A mass that depends on u, v, x and z, a constraint force whose direction depends on x and z.
struct Coupled {
  Sizes sizes() const { return {.nu = 2, .nx = 1, .nz = 1, .constraints = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T m = 1.0 + 0.3 * p.u[0] + 0.2 * p.v[0] + 0.7 * p.x[0] + 0.05 * p.z[0];
    r.u[0] = 3.0 * p.u[1] + 2.0 * p.v[1] + p.x[0] - m * p.a[0] - p.u[0] * p.z[0];
    r.u[1] = 5.0 * p.u[0] * p.u[0] - p.a[1] - p.u[1] * p.z[0];
    r.x[0] = p.u[0] - p.x[0] * p.x[0] - p.k[0];
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    g[0] = (u[0] * u[0] + u[1] * u[1] - 1.0) * 0.5;
  }
};

Linearization<double> termsOf(JacobianTerms terms, DerivativeSource source, double* second_d2) {
  const auto system = makeSystem<double>(Coupled{}, {Formulation::kIndex2});
  State<double> s(Coupled{}.sizes());
  s.u << 0.6, 0.8;
  s.v << 0.4, -0.3;
  s.x << 0.5;
  s.w << 2, -1, 0.35, 1.5;
  Linearization<double> D(Pattern::dense(4));
  Differentiator<double> differentiator(*system, source, terms);
  differentiator.evaluate(Level::kFormulated, pointOf(s), D);
  if (second_d2) {
    State<double> moved = s;
    moved.u << 0.8, 0.6;
    Linearization<double> again(Pattern::dense(4));
    differentiator.evaluate(Level::kFormulated, pointOf(moved), again);
    *second_d2 = again.dense2()(1, 0);
  }
  return D;
}

// By hand, rows (u0, u1, x, z): D0 by (a0, a1, k, z), D1 by (v0, v1, x, .), D2 by (u0, u1, ., .).
TEST(JacobianTermsOption, LeaveOutWhatTheySay) {
  const double m = 1 + 0.3 * 0.6 + 0.2 * 0.4 + 0.7 * 0.5 + 0.05 * 1.5, a = 2;
  for (const auto source : {DerivativeSource::kAutomatic, DerivativeSource::kCentral}) {
    const double tolerance = source == DerivativeSource::kAutomatic ? 1e-13 : 1e-8;
    for (const auto terms : {JacobianTerms::kFull, JacobianTerms::kNoMassVxz,
                             JacobianTerms::kNoMass, JacobianTerms::kConstantStiffness}) {
      double later = 0;
      const auto D = termsOf(terms, source, &later);
      const bool vxz = terms == JacobianTerms::kNoMassVxz || terms == JacobianTerms::kNoMass;
      const bool u = terms == JacobianTerms::kNoMass;
      EXPECT_NEAR(D.dense0()(0, 0), -m, tolerance) << idOf(terms);
      EXPECT_NEAR(D.dense0()(0, 3), -0.6 - (vxz ? 0 : 0.05 * a), tolerance) << idOf(terms);
      EXPECT_NEAR(D.dense1()(0, 0), vxz ? 0 : -0.2 * a, tolerance) << idOf(terms);
      EXPECT_NEAR(D.dense1()(0, 1), 2, tolerance) << idOf(terms);
      EXPECT_NEAR(D.dense1()(0, 2), 1 - (vxz ? 0 : 0.7 * a), tolerance) << idOf(terms);
      EXPECT_NEAR(D.dense2()(0, 0), -1.5 - (u ? 0 : 0.3 * a), tolerance) << idOf(terms);
      EXPECT_NEAR(D.dense2()(0, 1), 3, tolerance) << idOf(terms);
      EXPECT_NEAR(D.dense2()(1, 0), 10 * 0.6, tolerance) << idOf(terms);
      // Evaluated once: at another u it stays.
      const double at = terms == JacobianTerms::kConstantStiffness ? 0.6 : 0.8;
      EXPECT_NEAR(later, 10 * at, 10 * tolerance) << idOf(terms);
      EXPECT_NEAR(D.dense2()(3, 0), 0.4, tolerance) << "d/du of u.v";
      EXPECT_NEAR(D.dense1()(3, 1), 0.8, tolerance) << "d/dv of u.v";
    }
  }
}

/// Algebraic unknowns in the constraints' rows: z[1] in its own equation, x too.
struct Algebraic {
  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 2, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = p.z[0] - p.x[0] - p.k[0];
    r.z[0] = 3.0 * p.z[0] - p.x[0] + 0.5 * p.z[1];
    r.z[1] = 2.0 * p.z[1] - p.x[0] * p.x[0];
  }
};

TEST(JacobianTermsOption, NoConstraintXzDropsTheAlgebraicRows) {
  const auto system = makeSystem<double>(Algebraic{});
  State<double> s(Algebraic{}.sizes());
  s.x << 0.5;
  const auto of = [&](JacobianTerms terms) {
    Linearization<double> D(Pattern::dense(3));
    Differentiator<double>(*system, DerivativeSource::kAutomatic, terms)
        .evaluate(Level::kFormulated, pointOf(s), D);
    return D;
  };
  const auto full = of(JacobianTerms::kFull), dropped = of(JacobianTerms::kNoConstraintXz);
  EXPECT_EQ(full.dense0()(1, 1), 3);
  EXPECT_EQ(full.dense0()(1, 2), 0.5);
  EXPECT_EQ(full.dense1()(1, 0), -1);
  EXPECT_EQ(full.dense1()(2, 0), -1);
  EXPECT_EQ(dropped.dense0()(0, 1), 1) << "the row of x keeps its z";
  EXPECT_EQ(dropped.dense1()(0, 0), -1);
  for (Index row = 1; row < 3; ++row) {
    EXPECT_EQ(dropped.dense0()(row, 1), 0);
    EXPECT_EQ(dropped.dense0()(row, 2), 0);
    EXPECT_EQ(dropped.dense1()(row, 0), 0);
  }
}

/// An oscillator whose mass depends strongly on u and v: without those terms Newton contracts more
/// slowly.
struct HeavyMass {
  Sizes sizes() const { return {.nu = 1, .nx = 1, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -50.0 * p.u[0] - (1.0 + 0.1 * p.v[0] * p.v[0]) * p.a[0];
    r.x[0] = p.u[0] - p.k[0];
  }
};

TEST(JacobianTermsOption, CostIterationsNotAccuracy) {
  State<double> start(HeavyMass{}.sizes());
  start.u[0] = 1;
  start.x[0] = 0.5;
  // Fixed steps: Newton iterates to round-off, whatever its matrix.
  const auto with = [&](JacobianTerms terms) {
    IntegratorOptions o = fixedSteps(0.01);
    o.newton.kind = NewtonKind::kSimplified;
    o.jacobian = terms;
    return taken(HeavyMass{}, start, 1, o).solution;
  };
  const auto full = with(JacobianTerms::kFull);
  ASSERT_EQ(full.outcome, Outcome::kSuccess);
  for (const auto terms : {JacobianTerms::kNoMassVxz, JacobianTerms::kNoMass}) {
    const auto less = with(terms);
    ASSERT_EQ(less.outcome, Outcome::kSuccess) << less.detail;
    EXPECT_GT(less.counters.newton_iterations, full.counters.newton_iterations) << idOf(terms);
    EXPECT_NEAR(less.state.u[0], full.state.u[0], 1e-11) << idOf(terms);
  }
}

/// x' = -rate x, and 1.8 times (or another factor) as fast from t = 0.09 on.
struct Faster {
  double factor = 1.8;
  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = (p.t > T(0.09) ? -1e4 * factor : -1e4) * p.x[0] - p.k[0];
  }
};

// Two steps of the midpoint rule, h = 0.1. The first one takes an iteration; in the second one the
// kept matrix 1 + 500 stands for 1 + 900, so that residuals shrink by 400/501 = 0.798 until a new
// Jacobian is made. The paper's (3.2) and (3.4), iteration by iteration.
TEST(PapersNewton, FollowsItsRules) {
  State<double> start(Faster{}.sizes());
  start.x[0] = 1;
  const auto run = [&](double tolerance, double limit, int after, int most) {
    IntegratorOptions o = fixedSteps(0.1);
    o.newton.kind = NewtonKind::kModified;
    o.newton.residual_tolerance = tolerance;
    o.newton.contractivity_limit = limit;
    o.newton.contractivity_after = after;
    o.newton.max_iterations = most;
    o.predictor = Predictor::kAcceleration;
    o.jacobian_point = JacobianPoint::kStart;
    const auto solution =
        integrate<double>(Faster{}, start, 0.2, makeTableau<double>("gauss_1"), o);
    EXPECT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
    return solution.counters;
  };
  EXPECT_EQ(run(1e-1, 0.9, 3, 25).newton_iterations, 1 + 11) << "0.798^11 < 0.1";
  EXPECT_EQ(run(1e-2, 0.9, 3, 25).newton_iterations, 1 + 21);
  EXPECT_EQ(run(1e-2, 0.9, 3, 25).newton_restarts, 0);
  EXPECT_EQ(run(1e-2, 0.9, 3, 25).jacobians, 1);
  for (const int after : {1, 3, 6}) {
    const Counters c = run(1e-2, 0.7, after, 25);
    EXPECT_EQ(c.newton_iterations, 1 + after + 1 + 1) << "one more than " << after;
    EXPECT_EQ(c.newton_restarts, 1);
    EXPECT_EQ(c.jacobians, 2);
  }
  EXPECT_EQ(run(1e-2, 0.9, 3, 10).newton_iterations, 1 + 10 + 1) << "max_iterations";
  EXPECT_EQ(run(1e-2, 0.79, 3, 25).newton_restarts, 1) << "just above the limit";
  EXPECT_EQ(run(1e-2, 0.81, 3, 25).newton_restarts, 0) << "just below it";
}

// With 2.5 times the rate increments grow by 1.5: Newton fails, and starts again with a new
// Jacobian. All of its iterations belong to the step.
TEST(Counted, IterationsOfStepsAreThoseOfTheRun) {
  State<double> start(Faster{}.sizes());
  start.x[0] = 1;
  for (const auto kind : {NewtonKind::kSimplified, NewtonKind::kModified}) {
    IntegratorOptions o = fixedSteps(0.1);
    o.newton.kind = kind;
    o.predictor = Predictor::kAcceleration;
    Integrator<double> integrator(makeSystem<double>(Faster{2.5}), makeTableau<double>("gauss_1"),
                                  o);
    std::int64_t sum = 0;
    Monitor<double> monitor;
    monitor.accepted = [&](const StepRecord<double>& s) { sum += s.newton_iterations; };
    const auto solution = integrator.integrate(start, 0.4, monitor);
    ASSERT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
    EXPECT_EQ(solution.counters.newton_restarts, 1) << idOf(kind);
    EXPECT_EQ(sum, solution.counters.newton_iterations) << idOf(kind);
  }
}

// Weights atol scale + rtol |y|, powers of h by index, the mean over (u, v, x, z): number by
// number.
TEST(ErrorNorms, AreWhatTheirOptionsSay) {
  const auto system = makeSystem<double>(CartesianPendulum{}, {Formulation::kIndex3});
  Vec<double> scale(5);
  scale << 1, 2, 3, 4, 5;
  State<double> y(CartesianPendulum{}.sizes()), p = y, q = y;
  y.u << 10, 20;
  y.v << -30, 40;
  y.z() << 50;
  p.u << 1, 2;
  p.v << 3, 4;
  p.z() << 5;
  const Vec<double> ones = Vec<double>::Ones(5);
  const double h = 0.5;
  ErrorNorm<double> mixed(*system, {0.01, 0.1, NormKind::kMixed}, scale);
  mixed.update(y);
  // z times h^2; v is a result, and of index 2 all the same.
  const double e[] = {1 / (0.1 + 0.1), 2 / (0.2 + 0.2), 3 / (0.3 + 0.3), 4 / (0.4 + 0.4),
                      1.25 / (0.5 + 0.5)};
  double sum = 0;
  for (const double one : e) sum += one * one;
  EXPECT_NEAR(mixed.difference(p, q, h, ones), std::sqrt(sum / 5), 1e-13);
  EXPECT_NEAR(mixed.magnitude(p, h), std::sqrt(sum / 5), 1e-13);
  Vec<double> factor(5);
  factor << 0, 0, 0, 0, 2;
  EXPECT_NEAR(mixed.difference(p, q, h, factor), std::sqrt(2.5 * 2.5 / 5), 1e-13);
  ErrorNorm<double> absolute(*system, {0.01, 0.1, NormKind::kAbsolute}, scale);
  absolute.update(y);
  EXPECT_NEAR(absolute.difference(p, q, h, ones),
              std::sqrt(1 + 4 + 9 + 16 + 1.25 * 1.25) / 0.1, 1e-12);
}

TEST(ErrorNorms, WeighEveryComponentByItself) {
  const auto system = makeSystem<double>(Coupled{});
  State<double> y(Coupled{}.sizes()), zero = y;
  y.u << 1, 2;
  y.v << 4, 8;
  y.x << 16;
  y.z() << 32;
  ErrorNorm<double> norm(*system, {0.5, 1e-300, NormKind::kMixed}, {});
  norm.update(y);
  Vec<double> one = Vec<double>::Zero(6);
  for (Index i = 0; i < 5; ++i) {
    one.setZero();
    one[i] = 1;
    EXPECT_NEAR(norm.difference(y, zero, 1, one), 2 / std::sqrt(6), 1e-13) << "component " << i;
  }
}

// 2^q - 1 by the order q of each component: HW II, tables VII.4.1 and VII.6.1 for the stages'
// orders.
TEST(RichardsonFactors, AreOfTheComponentsOrders) {
  const auto orders = [](const char* method, Formulation formulation, ErrorEstimate estimate) {
    const auto system = makeSystem<double>(CartesianPendulum{}, {formulation});
    const Vec<double> factor =
        doublingFactors(Scheme<double>(makeTableau<double>(method)), *system, estimate);
    std::vector<double> found;
    for (const double f : factor) found.push_back(std::round(1e6 * std::log2(1 / f + 1)) / 1e6);
    return found;
  };
  using Orders = std::vector<double>;
  constexpr auto kOwn = ErrorEstimate::kRichardson, kAll = ErrorEstimate::kDoubling;
  // u1, u2, v1, v2, z
  EXPECT_EQ(orders("radau_iia_3", Formulation::kIndex2, kOwn), (Orders{5, 5, 5, 5, 3}));
  EXPECT_EQ(orders("radau_iia_3", Formulation::kIndex3, kOwn), (Orders{5, 5, 3, 3, 2}));
  EXPECT_EQ(orders("radau_iia_3", Formulation::kIndex1, kOwn), (Orders{5, 5, 5, 5, 5}));
  EXPECT_EQ(orders("gauss_3", Formulation::kIndex2, kOwn), (Orders{6, 6, 3, 3, 3}));
  EXPECT_EQ(orders("gauss_3", Formulation::kIndex3, kOwn), (Orders{3, 3, 3, 3, 2}));
  EXPECT_EQ(orders("radau_iia_3", Formulation::kIndex3, kAll), (Orders{5, 5, 5, 5, 5}));
}

struct Decay {
  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = -p.x[0] - p.k[0];
  }
};

// Simplified Newton evaluates s residuals per iteration; the residual test needs one more set per
// solve.
TEST(Counted, ResidualsAreWhatTheAlgorithmsNeed) {
  State<double> start(Decay{}.sizes());
  start.x[0] = 1;
  const auto counters = [&](NewtonKind kind, const char* method, int steps) {
    IntegratorOptions o = fixedSteps(1.0 / steps);
    o.newton.kind = kind;
    o.solver = StageSolverKind::kCoupledDense;
    o.predictor = Predictor::kAcceleration;
    return integrate<double>(Decay{}, start, 1, makeTableau<double>(method), o).counters;
  };
  struct Case {
    const char* method;
    int implicit;
  };
  for (const auto& [method, s] :
       {Case{"radau_iia_3", 3}, Case{"gauss_2", 2}, Case{"lobatto_iiia_4", 3}}) {
    for (const auto kind : {NewtonKind::kSimplified, NewtonKind::kModified, NewtonKind::kFull}) {
      const Counters few = counters(kind, method, 8), many = counters(kind, method, 24);
      const auto iterations = many.newton_iterations - few.newton_iterations;
      const auto first = kind == NewtonKind::kSimplified ? 0 : 16;
      EXPECT_EQ(many.residuals - few.residuals, s * (iterations + first)) << method << idOf(kind);
      EXPECT_EQ(many.solves - few.solves, iterations) << method << idOf(kind);
      EXPECT_EQ(many.steps_accepted - few.steps_accepted, 16);
      if (kind == NewtonKind::kFull) {
        EXPECT_EQ(many.jacobians - few.jacobians, s * iterations) << "one per stage";
        EXPECT_EQ(many.factorizations - few.factorizations, iterations);
      } else {
        EXPECT_EQ(many.jacobians, few.jacobians) << "linear: one serves all";
      }
    }
  }
}

// Doubling: a step and two halves, whose two step sizes keep a factorization each.
TEST(Counted, DoublingSolvesThreeTimes) {
  State<double> start(Decay{}.sizes());
  start.x[0] = 1;
  for (const auto estimate :
       {ErrorEstimate::kDoubling, ErrorEstimate::kRichardson, ErrorEstimate::kDoublingScalar}) {
    IntegratorOptions o = adaptive(1e-2);
    o.step.estimate = estimate;
    o.step.control = StepControl::kPaper;
    o.step.h = 0.125;
    o.step.h_max = 0.125;
    o.newton.kind = NewtonKind::kModified;
    o.predictor = Predictor::kAcceleration;
    const auto all = taken(Decay{}, start, 1, o, "radau_iia_2").solution;
    ASSERT_EQ(all.outcome, Outcome::kSuccess);
    EXPECT_EQ(all.counters.steps_accepted, 8) << idOf(estimate);
    EXPECT_EQ(all.counters.newton_iterations, 24) << idOf(estimate);
    EXPECT_EQ(all.counters.solves, 24) << idOf(estimate);
    EXPECT_EQ(all.counters.factorizations, 2) << idOf(estimate);
    EXPECT_EQ(all.counters.jacobians, 1) << idOf(estimate);
  }
}

// Stages over threads: the same bits, the same counts.
TEST(Threads, OfOneIntegrationChangeNothing) {
  for (const auto solver : {StageSolverKind::kSchur, StageSolverKind::kEigen}) {
    IntegratorOptions o = adaptive(1e-8);
    o.step.control = StepControl::kPredictive;
    o.step.estimate = ErrorEstimate::kRichardson;
    o.solver = solver;
    const auto one = taken(CartesianPendulum{}, pendulumStart<double>(), 2, o, "radau_iia_5");
    o.threads = 3;
    const auto three = taken(CartesianPendulum{}, pendulumStart<double>(), 2, o, "radau_iia_5");
    EXPECT_EQ(one.solution.state.u, three.solution.state.u);
    EXPECT_EQ(one.solution.state.w, three.solution.state.w);
    EXPECT_EQ(one.h, three.h);
    std::vector<std::int64_t> a, b;
    one.solution.counters.forEach([&](const char*, std::int64_t n) { a.push_back(n); });
    three.solution.counters.forEach([&](const char*, std::int64_t n) { b.push_back(n); });
    EXPECT_EQ(a, b);
  }
}

}  // namespace
}  // namespace irk::test
