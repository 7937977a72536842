// (a, k, z) from (u, v, x).
#include "core/derivatives/consistent_start.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/system/counting.h"
#include "irk/misuse.h"
#include "tests/core/support.h"
#include "tests/refusal.h"

namespace irk::test {
namespace {

/// x' = z with an equation for z that depends on x.
enum class Equation { kSquare, kRoot, kNone };
struct Algebraic {
  Equation equation;
  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 1, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sqrt;
    r.x[0] = p.z[0] - p.k[0];
    if (equation == Equation::kSquare) r.z[0] = p.z[0] * p.z[0] - p.x[0];
    if (equation == Equation::kRoot) r.z[0] = sqrt(p.x[0]) - p.z[0];
    if (equation == Equation::kNone) r.z[0] = p.x[0] - 1.0;
  }
};

struct Found {
  StartReport report;
  State<double> state;
};
Found start(Equation equation, double x, double z, bool w_required = true) {
  const auto system = makeSystem<double>(Algebraic{equation}, {});
  Found found{{}, State<double>(system->sizes())};
  found.state.x[0] = x;
  found.state.w << z, z;
  found.report = ConsistentStart<double>(*system, DerivativeSource::kAutomatic, w_required).apply(found.state);
  return found;
}

// Newton's method for a square root converges to the root on the side of its start value. With derivatives kept from
// these starts it would not.
TEST(ConsistentStart, KeptDerivativesDoNotLeadToAnotherRoot) {
  for (const double z : {0.01, 0.3, 0.9, 1.0, 30.0}) {
    const auto found = start(Equation::kSquare, 1, z);
    EXPECT_EQ(found.report.outcome, Outcome::kSuccess) << found.report.detail;
    EXPECT_NEAR(found.state.z()[0], 1, 1e-14) << z;
    EXPECT_NEAR(found.state.k()[0], 1, 1e-14) << z;
  }
  EXPECT_NEAR(start(Equation::kSquare, 1, -0.3).state.z()[0], -1, 1e-14);
}

TEST(ConsistentStart, FailuresNameThePlaceAndKeepWhatIsGiven) {
  const auto none = start(Equation::kSquare, -1, 0.7);
  EXPECT_EQ(none.report.outcome, Outcome::kInconsistentStart);
  EXPECT_TRUE(contains(none.report.detail, "row 1: Newton does not converge"));
  EXPECT_EQ(none.state.z()[0], 0.7);
  const auto nan = start(Equation::kRoot, -1, 0.7);
  EXPECT_EQ(nan.report.outcome, Outcome::kNotFinite);
  EXPECT_TRUE(contains(nan.report.detail, "at the start, t = 0: row 1: residual"));
  EXPECT_EQ(nan.state.z()[0], 0.7);
}

// An equation without a root, whose residual is small enough for a start. At the end of a run it must not pass as a
// solution.
TEST(ConsistentStart, AtTheEndOnlyConvergedValuesCount) {
  const auto system = makeSystem<double>(Algebraic{Equation::kSquare}, {});
  State<double> state(system->sizes());
  state.x[0] = -1e-20;
  state.w << 1e-4, 1e-4;
  const Vec<double> given = state.w;
  ConsistentStart<double> start(*system, DerivativeSource::kAutomatic, false);
  EXPECT_TRUE(contains(start.applyAtEnd(state), "multipliers of the stages: consistent (a, k, z), t = 0: "));
  EXPECT_EQ(state.w, given);
  EXPECT_EQ(start.apply(state).outcome, Outcome::kSuccess);
}

TEST(ConsistentStart, KeepsUndeterminedValuesWhereThatIsAllowed) {
  const auto kept = start(Equation::kNone, 1, 0.7);
  EXPECT_EQ(kept.report.outcome, Outcome::kSuccess) << kept.report.detail;
  EXPECT_EQ(kept.state.z()[0], 0.7);
  EXPECT_EQ(start(Equation::kNone, 1, 0.7, false).report.outcome, Outcome::kSuccess);
  EXPECT_EQ(start(Equation::kNone, 2, 0.7, false).report.outcome, Outcome::kInconsistentStart) << "x = 2 is not 1";
  EXPECT_EQ(start(Equation::kNone, 2, 0.7, true).report.outcome, Outcome::kInconsistentStart);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(start(Equation::kNone, nan, 0.7, false).report.outcome, Outcome::kNotFinite);
}

/// A pendulum of length l in units of which `unit` are one metre; its constraint is multiplied by `factor`.
struct PendulumIn {
  double unit, factor;
  Sizes sizes() const { return {.nu = 2, .nx = 0, .nz = 1, .constraints = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T force = p.z[0] * factor;
    r.u[0] = -p.a[0] - p.u[0] * force;
    r.u[1] = -p.a[1] - 9.81 * unit - p.u[1] * force;
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    g[0] = (u[0] * u[0] + u[1] * u[1] - unit * unit) * (0.5 * factor);
  }
};

/// A start with a relative error `du` of the length, and with a fraction `dv` of the velocity along the rod.
Outcome pendulumOutcome(const PendulumIn& problem, Formulation formulation, double du, double dv) {
  const auto system = makeSystem<double>(problem, {formulation});
  const double m = problem.unit;
  State<double> scene(problem.sizes());
  scene.u << 0.6 * m * (1 + du), -0.8 * m * (1 + du);
  scene.v << (0.8 + 0.6 * dv) * m, (0.6 - 0.8 * dv) * m;
  State<double> state = system->fromScene(scene);
  Vec<double> scale = Vec<double>::Ones(system->sizes().components());
  scale.head(4).setConstant(m);
  return ConsistentStart<double>(*system, DerivativeSource::kAutomatic, false, nullptr, scale).apply(state).outcome;
}

// Off by a thousandth is a mistake, off by 1e-8 is a start given with eight digits.
TEST(ConsistentStart, ConstraintsAreJudgedAlikeInAllUnits) {
  for (const double unit : {1e-10, 1e-3, 1.0, 1e3, 1e6}) {
    for (const double factor : {1.0, 1e-9, 1e9}) {
      for (const Formulation f : {Formulation::kIndex2, Formulation::kIndex3, Formulation::kGgl}) {
        const PendulumIn problem{unit, factor};
        const auto outcome = [&](double du, double dv) { return name(pendulumOutcome(problem, f, du, dv)); };
        SCOPED_TRACE(testing::Message() << idOf(f) << ", unit " << unit << ", factor " << factor);
        EXPECT_EQ(outcome(0, 0), "success");
        EXPECT_EQ(outcome(1e-12, 1e-12), "success");
        EXPECT_EQ(outcome(1e-8, 1e-8), "success");
        EXPECT_EQ(outcome(1e-3, 0), "inconsistent_start");
        EXPECT_EQ(outcome(0, 1e-3), "inconsistent_start");
        EXPECT_EQ(outcome(-1e-6, 0), "inconsistent_start");
        EXPECT_EQ(outcome(0, -1e-6), "inconsistent_start");
      }
    }
  }
}

// The scale decides where the start is zero: a mechanism at rest, whose constraint moves slowly.
TEST(ConsistentStart, ConstraintsAreJudgedByTheScaleWhereTheStartIsZero) {
  const auto outcome = [](double v, double scale) {
    const PendulumIn problem{1, 1};
    const auto system = makeSystem<double>(problem, {});
    State<double> state = startOf(problem, {.u = {1, 0}, .v = {v, 0}});
    Vec<double> scales(5);
    scales << 1, 1, scale, scale, 1;
    return ConsistentStart<double>(*system, DerivativeSource::kAutomatic, false, nullptr, scales).apply(state).outcome;
  };
  EXPECT_EQ(outcome(1e-9, 1), Outcome::kSuccess);
  EXPECT_EQ(outcome(1e-9, 1e-3), Outcome::kInconsistentStart);
  EXPECT_EQ(outcome(1e-5, 1e3), Outcome::kSuccess);
  EXPECT_EQ(outcome(1e-5, 1), Outcome::kInconsistentStart);
}

// In eight digits its direction is (1, 1e-8), along which a fast mass moves by 1e-5.
TEST(ConsistentStart, AFastStartMayBeGivenWithEightDigits) {
  const auto system = makeSystem<double>(CartesianPendulum{}, {});
  State<double> state = pendulumStart<double>();
  state.u[1] = 1e-8;
  state.v[1] = 1e3;
  EXPECT_EQ(ConsistentStart<double>(*system, DerivativeSource::kAutomatic, false).apply(state).outcome,
            Outcome::kSuccess);
  state.u[1] = 1e-5;
  EXPECT_EQ(ConsistentStart<double>(*system, DerivativeSource::kAutomatic, false).apply(state).outcome,
            Outcome::kInconsistentStart);
}

// Expected: one evaluation each of g and dg/dt, and those of Newton's method, which corrects once and checks the next
// correction.
TEST(ConsistentStart, JudgingTakesNoCountedEvaluations) {
  const auto system = makeSystem<double>(CartesianPendulum{}, {});
  State<double> state = pendulumStart<double>();
  Counters counters;
  const CountingSystem<double> counted(*system, counters);
  EXPECT_EQ(ConsistentStart<double>(counted, DerivativeSource::kAutomatic, false, &counters).apply(state).outcome,
            Outcome::kSuccess);
  EXPECT_EQ(counters.residuals, 4);
  EXPECT_EQ(counters.jacobians, 1);
}

TEST(ConsistentStart, ConstraintsOfTheFirstOrderFormAreJudged) {
  const auto system = makeSystem<double>(CartesianPendulum{}, {Formulation::kFirstOrder});
  State<double> scene = pendulumStart<double>();
  const auto outcome = [&] {
    State<double> state = system->fromScene(scene);
    return ConsistentStart<double>(*system, DerivativeSource::kAutomatic, false).apply(state).outcome;
  };
  EXPECT_EQ(outcome(), Outcome::kSuccess);
  scene.u[0] = 1.01;
  EXPECT_EQ(outcome(), Outcome::kInconsistentStart);
}

/// x' = c z with an algebraic unknown that the equations do not determine at once: x = `unit`.
struct Unknown {
  double unit;
  Sizes sizes() const { return {.nx = 1, .nz = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = p.z[0] - p.k[0];
    r.z[0] = (p.x[0] - unit) * 1e3;
  }
};

TEST(ConsistentStart, RemainingResidualsAreJudgedAlikeInAllUnits) {
  for (const double unit : {1e-12, 1.0, 1e9}) {
    const auto outcome = [unit](double x_off, double k_off) {
      const auto system = makeSystem<double>(Unknown{unit}, {});
      State<double> state(system->sizes());
      state.x[0] = unit * (1 + x_off);
      state.w << unit * (1 + k_off), unit;
      const Vec<double> scale = Vec<double>::Constant(2, unit);
      ConsistentStart<double> start(*system, DerivativeSource::kAutomatic, true, nullptr, scale);
      return name(start.apply(state).outcome);
    };
    EXPECT_EQ(outcome(0, 0), "success") << unit;
    EXPECT_EQ(outcome(1e-12, 1e-12), "success") << unit;
    EXPECT_EQ(outcome(1e-3, 0), "inconsistent_start") << unit;
    EXPECT_EQ(outcome(0, 1e-3), "inconsistent_start") << unit;
  }
}

TEST(ConsistentStart, AScaleOfAnotherLengthIsRefused) {
  const auto system = makeSystem<double>(CartesianPendulum{}, {});
  const Vec<double> scale = Vec<double>::Ones(3);
  EXPECT_THROW(ConsistentStart<double>(*system, DerivativeSource::kAutomatic, false, nullptr, scale), Misuse);
}

/// x_i' = gain z_i - x_i and 0 = weight (z_i - i / gain): as with kilovolts and picofarads.
struct Gains {
  Index m;
  double gain, weight;
  Sizes sizes() const { return {.nx = m, .nz = m}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    for (Index i = 0; i < m; ++i) {
      r.x[i] = gain * p.z[i] - p.x[i] - p.k[i];
      r.z[i] = weight * (p.z[i] - static_cast<double>(i) / gain);
    }
  }
};

// Both for a dense and for a sparse matrix.
TEST(ConsistentStart, UnitsDoNotMakeAMatrixSingular) {
  for (const Index m : {2, 40}) {
    for (const double gain : {1e-9, 1.0, 1e9}) {
      const auto system = makeSystem<double>(Gains{m, gain, 1});
      State<double> state(system->sizes());
      const auto report = ConsistentStart<double>(*system, DerivativeSource::kAutomatic, true).apply(state);
      EXPECT_EQ(report.outcome, Outcome::kSuccess) << m << ' ' << gain << ": " << report.detail;
      for (Index i = 0; i < m; ++i) EXPECT_NEAR(state.k()[i], static_cast<double>(i), 1e-12 * static_cast<double>(m));
    }
  }
}

TEST(ConsistentStart, ARowOfRoundOffDeterminesNothing) {
  for (const Index m : {2, 40}) {
    const auto system = makeSystem<double>(Gains{m, 1, 1e-17});
    State<double> state(system->sizes());
    ConsistentStart<double> start(*system, DerivativeSource::kAutomatic, false);
    EXPECT_EQ(start.apply(state).outcome, Outcome::kSuccess);
    EXPECT_EQ(state.z().norm(), 0) << "nothing is solved for";
  }
}

}  // namespace
}  // namespace irk::test
