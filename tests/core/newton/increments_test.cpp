// What Newton's method concludes from the sizes of its increments.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/core/one_step.h"

namespace irk::test {
namespace {

// F(z) = (d + sqrt(d^2 + s^2)) / 2 + e (z - r(t)), d = z - c(t): the slope is 1 above the corner c, where the start
// values are, and e below it, where the root of the next stage is. The first increment leads to the corner, the second
// one is 25 tolerances, and the root is 25 000 tolerances away.
struct Corner {
  static constexpr double kTolerance = 1e-5, kShare = 1e-3, kSharpness = 1e-5;
  static constexpr double kMove = 3;      // of the corner, to t = 1
  static constexpr double kBelow = 0.25;  // the root below the corner at t = 1
  static constexpr double kAbove = 1;     // the root above the corner at t = 0, z = 0

  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 1, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sqrt;
    const T c = -kAbove + (kAbove - kMove) * p.t;
    const T root = (1 - p.t) * (kAbove / kShare) - (kMove + kBelow) * p.t;
    const T d = p.z[0] - c;
    r.x[0] = p.k[0];
    r.z[0] = 0.5 * (d + sqrt(d * d + kSharpness * kSharpness)) + kShare * (p.z[0] - root);
  }
};

// One tiny contraction after a huge increment proves nothing. One step of the implicit Euler method: the root's z is
// -3.25.
TEST(Increments, ATinyContractionAfterAHugeIncrementDoesNotCount) {
  OneStep step(Corner{}, "radau_iia_1", adaptive(Corner::kTolerance), {0, Corner::kTolerance, NormKind::kAbsolute});
  EXPECT_EQ(step.solve(State<double>(Corner{}.sizes()), 1), Outcome::kNewtonFailed) << step.to.z()[0];
}

/// A box on a table that oscillates with 2 cos 5t, driven by friction that rises over the width vs, falls to half and
/// stays: nearly linear while it slides, a steep transition when it turns.
struct StribeckBox {
  double vs;
  Sizes sizes() const { return {.nu = 1}; }
  template <class T>
  T step5(const T& x) const {
    return x * x * x * (10 + x * (6 * x - 15));
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    const T slip = p.v[0] - 2 * cos(5 * p.t);
    const T s = slip > T(0) ? T(slip / vs) : T(-slip / vs);
    const T mu = s >= T(3) ? T(0.5) : s >= T(1) ? T(1 - 0.5 * step5(T((s - 1) / 2))) : T(step5(s));
    r.u[0] = p.a[0] + (slip > T(0) ? mu : T(-mu)) * 9.81;
  }
};

// Right values: two independent integrators with 60-digit Taylor series and event location (see the list of
// faults). One iteration with an increment of 1e6 tolerances was accepted here, and two stages had an acceleration that
// was wrong by 9.81.
TEST(Increments, ARememberedContractionEndsNoIterationAfterALargeIncrement) {
  for (const double tol : {1e-5, 1e-6, 1e-7, 1e-8}) {
    for (const char* method : {"radau_iia_3", "radau_iia_5"}) {
      const auto s = integrate<double>(StribeckBox{1e-2}, State<double>(StribeckBox{1e-2}.sizes()), 2,
                                       makeTableau<double>(method), embedded(tol));
      ASSERT_EQ(s.outcome, Outcome::kSuccess) << s.detail;
      EXPECT_NEAR(s.state.u[0], -0.2710997123700737, 1000 * tol) << method << " tol " << tol;
      EXPECT_NEAR(s.state.v[0], -1.683422118462708, 1000 * tol) << method << " tol " << tol;
    }
  }
}

/// y' = 6 t, x' = c y^2 from zero: y = 3 t^2, x = 9 c t^5 / 5. At the start x' does not depend on y. In the first step
/// with the Jacobian from there, the first increment is that of y' alone, the second one that of x' alone, and the
/// third is zero.
struct Hidden {
  double c;
  Sizes sizes() const { return {.nx = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = c * (p.x[1] * p.x[1]) - p.k[0];
    r.x[1] = 6 * p.t - p.k[1];
  }
};

constexpr double kPatienceStep = 0.1;

Solution<double> follow(double c, const IntegratorOptions& options) {
  return integrate<double>(Hidden{c}, State<double>(Hidden{c}.sizes()), kPatienceStep, makeTableau<double>("gauss_3"),
                           options);
}

// The second increment is about three times the first one.
TEST(Increments, ALargerOneEndsNoFixedStep) {
  const auto solution = follow(2000, fixedSteps(kPatienceStep));
  ASSERT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
  EXPECT_NEAR(solution.state.x[0], 9 * 2000 * 1e-5 / 5, 1e-13);
  EXPECT_NEAR(solution.state.x[1], 0.03, 1e-15);
  EXPECT_EQ(solution.counters.newton_iterations, 3);
}

// Nor does one a hundred times the first: the third is zero here, too.
TEST(Increments, AMuchLargerOneEndsNoFixedStep) {
  const auto solution = follow(1e5, fixedSteps(kPatienceStep));
  ASSERT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
  EXPECT_NEAR(solution.state.x[0], 9 * 1e5 * 1e-5 / 5, 1e-11);
}

// x = tan t ends at pi / 2: the equations of a step beyond it have no solution.
TEST(Increments, GrowUpToTheLimitOfIterations) {
  IntegratorOptions options = fixedSteps(4);
  options.newton.max_iterations = 8;
  const FirstOrder tangent{[](const auto& p) { return 1.0 + p.x[0] * p.x[0]; }};
  const auto solution =
      integrate<double>(tangent, State<double>(tangent.sizes()), 4, makeTableau<double>("radau_iia_2"), options);
  EXPECT_TRUE(solution.outcome == Outcome::kNewtonFailed || solution.outcome == Outcome::kNotFinite);
  EXPECT_LE(solution.counters.newton_iterations, 4 * 8 * 2);
}

// A shorter step costs less than to go on.
TEST(Increments, ALargerOneEndsAStepThatCanBeShortened) {
  IntegratorOptions options = adaptive(1e-3);
  options.step.h = kPatienceStep;
  const auto solution = follow(2000, options);
  EXPECT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
  EXPECT_GT(solution.counters.steps_rejected_newton, 0);
}

// Two bodies of other masses that are coupled by their mass matrix, at rest, and that regularised friction of size 1
// does not hold: from 1e-9 on it is constant, and at rest its derivative is -1e10 or more. Exact but for eps: v = a t.
struct Breakaway {
  double eps;
  Sizes sizes() const { return {.nu = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::tanh;
    r.u[0] = 2 * p.a[0] + p.a[1] - 6.0 + tanh(p.v[0] / eps);  // a = (2, 1)
    r.u[1] = p.a[0] + 3 * p.a[1] - 6.0 + tanh(p.v[1] / eps);
  }
};

/// x' = 1 / x, x = sqrt(x0^2 + 2 t): as the rise of a liquid in a capillary. -x is a solution as well; from an x0 far
/// below the tolerance it may be taken.
struct Rise {
  Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = 1.0 / p.x[0] - p.k[0];
  }
};

/// A body that friction holds at v = eps atanh(0.3), on a path of its own speed.
struct Stuck {
  double eps;
  Sizes sizes() const { return {.nx = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::tanh;
    r.x[0] = 0.3 - tanh(p.x[0] / eps) - p.k[0];
    r.x[1] = 1.0 + p.x[0] - 0.1 * p.x[1] - p.k[1];
  }
};

struct Judged {
  int successes = 0, wrong = 0;
  void add(const Solution<double>& solution, double value, double exact, double tol) {
    if (solution.outcome != Outcome::kSuccess) return;
    ++successes;
    if (!(std::abs(value - exact) <= 1000 * tol * std::max(1.0, std::abs(exact)))) ++wrong;
  }
};

// The matrix of the step's start is 1e5 to 1e15 times larger than the derivatives in the stages. The first increment is
// below round-off, whatever the residual is. Ended by it, runs gave v = -1000 and 1007, x = 1e9 and -1.41, as
// successes.
TEST(Increments, ATinyOneOfATooLargeMatrixEndsNothing) {
  for (const auto& method : {"radau_iia_2", "radau_iia_3", "radau_iia_5", "lobatto_iiic_4"}) {
    Judged breaks, rises, sticks;
    for (const double tol : {1e-2, 1e-3, 1e-4, 1e-6}) {
      for (IntegratorOptions options : {adaptive(tol), embedded(tol), variable(tol)}) {
        options.step.max_steps = 20'000;
        for (const double small : {1e-6, 1e-8, 1e-10}) {
          const auto tableau = makeTableau<double>(method);
          const auto broken = integrate<double>(Breakaway{small}, startOf(Breakaway{small}, {}), 1, tableau, options);
          breaks.add(broken, broken.state.v[0], 2, tol);
          const auto risen = integrate<double>(Rise{}, startOf(Rise{}, {.x = {small}}), 1, tableau, options);
          rises.add(risen, std::abs(risen.state.x[0]), std::sqrt(2 + small * small), tol);
          const auto stuck = integrate<double>(Stuck{small}, startOf(Stuck{small}, {}), 3, tableau, options);
          sticks.add(stuck, stuck.state.x[0], 0, tol);
        }
      }
    }
    for (const auto& [name, all] : {std::pair("breaks away", breaks), {"rises", rises}, {"sticks", sticks}}) {
      EXPECT_EQ(all.wrong, 0) << name << ' ' << method;
      EXPECT_GE(all.successes, 18) << name << ' ' << method << ": of 36";
    }
  }
}

}  // namespace
}  // namespace irk::test
