// Motions that leave an unstable rest, and error bars that follow them.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>

#include "tests/core/error_bar_run.h"
#include "tests/core/resting_systems.h"

namespace irk::test {
namespace {

/// A population near its capacity 1, x' = -x (1 - x): x = 1 / (1 + d e^t) with x(0) = 1 / (1 + d).
struct AtCapacity {
  double d = 1e-9;
  Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = -p.x[0] * (1.0 - p.x[0]) - p.k[0];
  }
  double exact(double t) const { return 1 / (1 + d * std::exp(t)); }
  State<double> start() const { return startOf(sizes(), {.x = {exact(0)}}); }
};

void expectCovered(const ErrorBar& bar, Index i, double error) {
  EXPECT_LT(error, 1.1 * bar.x[i]) << "component " << i;
  EXPECT_GT(error, 0.9 * bar.x[i]) << "component " << i;
}

TEST(UnstableRest, ADeviationBelowTheToleranceIsFollowed) {
  const AtCapacity problem;
  const double t_end = 40;
  for (const double tol : {1e-3, 1e-4}) {
    const auto run = measuredRun(problem, problem.start(), t_end, embedded(tol));
    EXPECT_NEAR(run.first.state.x[0], 1, 1e-3) << "the run itself stays at rest";
    expectCovered(run.bar, 0, std::abs(run.first.state.x[0] - problem.exact(t_end)));
  }
}

TEST(UnstableRest, AnOscillationThatGrowsIsFollowed) {
  const Spiral problem{1, 100};
  const double t_end = 15, radius = 1e-6 * std::exp(t_end);
  const auto run = measuredRun(problem, problem.start(), t_end, embedded(1e-4));
  expectCovered(run.bar, 0, std::abs(run.first.state.x[0] - 1 - radius * std::cos(100 * t_end)));
  expectCovered(run.bar, 1, std::abs(run.first.state.x[1] - 1 - radius * std::sin(100 * t_end)));
  EXPECT_TRUE(run.bar.remark.empty()) << run.bar.remark;
}

TEST(UnstableRest, IsFollowedWhereOtherComponentsMove) {
  for (const double L : {10.0, 30.0, 100.0, 300.0}) {
    const RestBesideMotion problem{L};
    const auto run = measuredRun(problem, problem.start(), 10, embedded(1e-4));
    EXPECT_LE(std::abs(run.first.state.x[0] - 1 - M_PI), run.bar.x[0] + 1e-3) << L;
    EXPECT_LE(std::abs(run.first.state.u[0] - std::cos(10.0)), 3 * run.bar.u[0] + 1e-3) << L;
  }
}

/// The same beside components that decay: seven components, so that few steps have eigenvalues.
struct RestBesideMany {
  double L;
  double deviation;
  Sizes sizes() const { return {.nu = 1, .nx = 5}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sin;
    r.u[0] = -900.0 * p.u[0] - p.a[0];
    r.x[0] = L * sin(p.x[0] - 1.0) - p.k[0];
    for (Index i = 1; i < 5; ++i) r.x[i] = 1.0 - p.x[i] - p.k[i];
  }
  State<double> start() const { return startOf(sizes(), {.u = {1}, .x = {1 + deviation, 0.5, 2, 0.1, 0.7}}); }
};

// Whoever does not look at the first steps leaves the rest in a random one of two directions. (Lobatto IIIC with an odd
// number of stages multiplies growing motions by a negative number in long steps.)
TEST(UnstableRest, IsFoundAtTheStartOfFastMotions) {
  for (const double L : {30.0, 100.0, 300.0, 1000.0, 3000.0, 10000.0}) {
    for (const double in_tolerances : {0.0001, -0.001, 0.003, -0.01, 0.03, -0.1, 0.3, -0.7}) {
      for (const double tol : {1e-4, 1e-5, 1e-6}) {
        const RestBesideMany problem{L, in_tolerances * tol};
        const auto system = makeSystem<double>(problem);
        const IntegratorOptions options = embedded(tol);
        Integrator<double> one(system, makeTableau<double>("radau_iia_3"), options);
        Integrator<double> two(system, makeMethods<double>("lobatto_iiic", 13, 5), independentOptions<double>(options));
        Solution<double> second;
        const State<double> first = one.integrate(problem.start(), 3).state;
        EXPECT_TRUE(measureErrorBar(first, two, problem.start(), options.tolerances, {}, second).known());
        EXPECT_NEAR(second.state.x[0], 1 + std::copysign(M_PI, in_tolerances), tol)
            << "L " << L << " deviation " << problem.deviation << " tol " << tol;
      }
    }
  }
}

/// A spiral around (1, 1) that decays until t = turn and grows from there on. Its radius is e^(slope t (t / 2 - turn)):
/// e^-depth at the turn, 1 again at 2 turn.
struct LateSpiral {
  double slope, frequency, depth;
  double turn() const { return std::sqrt(2 * depth / slope); }
  double radius(double t) const { return std::exp(slope * t * (t / 2 - turn())); }
  Sizes sizes() const { return {.nx = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T x = p.x[0] - 1.0, y = p.x[1] - 1.0, growth = slope * (p.t - turn());
    r.x[0] = growth * x - frequency * y - p.k[0];
    r.x[1] = frequency * x + growth * y - p.k[1];
  }
  State<double> start() const { return startOf(sizes(), {.x = {2, 1}}); }
};

// The motion rests, in few and long steps, when its rest becomes unstable, and what grows then is what the decay has
// left: down to e^-26 = 5e-12. It comes to rest with an error of a part of the tolerance, which remains the same part.
TEST(UnstableRest, OneThatBecomesUnstableLaterIsFollowedThroughItsDecay) {
  for (const double slope : {0.3, 10.0}) {
    for (const double frequency : {0.0, 3.0, 30.0}) {
      for (const auto& [depth, tol] : {std::pair(12.0, 1e-2), std::pair(20.0, 1e-3), std::pair(26.0, 1e-6)}) {
        const LateSpiral problem{slope, frequency, depth};
        const double t = 2 * problem.turn();
        const MeasuredRun run = measuredRun(problem, problem.start(), t, embedded(tol));
        const auto radius = [](const State<double>& s) { return std::hypot(s.x[0] - 1, s.x[1] - 1); };
        const std::string what = std::to_string(slope) + ' ' + std::to_string(frequency) + ' ' + std::to_string(depth);
        EXPECT_GT(std::abs(std::log(radius(run.first.state))), 1) << what << ": the run itself has lost it";
        EXPECT_NEAR(radius(run.second.state), problem.radius(t), 0.3) << what;
        const double error = std::hypot(run.first.state.x[0] - 1 - std::cos(frequency * t),
                                        run.first.state.x[1] - 1 - std::sin(frequency * t));
        EXPECT_NEAR(run.bar.x.norm(), error, 0.3 * error) << what;
        EXPECT_TRUE(run.bar.remark.empty()) << what << ": " << run.bar.remark;
      }
    }
  }
}

/// The same beside ten components that rest, so that eigenvalues are computed once in twelve steps.
struct LateSpiralBesideTen {
  LateSpiral spiral;
  Sizes sizes() const { return {.nx = 12}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    spiral.residual(p, r);
    for (Index i = 2; i < 12; ++i) r.x[i] = 3.0 - p.x[i] - p.k[i];
  }
};

// Twelve steps of a twentieth of the interval are more than the time from the turn to the return.
TEST(UnstableRest, StepsOfATwentiethOfTheIntervalPassOverNothing) {
  for (const double part : {0.03, 0.04, 0.049, 0.06}) {
    const LateSpiralBesideTen problem{{1, 3, 16}};
    State<double> start(problem.sizes());
    start.x.setConstant(3);
    start.x.head(2) << 2, 1;
    const double t = 2 * problem.spiral.turn();
    IntegratorOptions options = embedded(1e-3);
    options.step.h_max = part * t;
    const MeasuredRun run = measuredRun(problem, start, t, options);
    EXPECT_NEAR(std::hypot(run.second.state.x[0] - 1, run.second.state.x[1] - 1), 1, 0.3) << part;
    EXPECT_TRUE(run.bar.remark.empty()) << run.bar.remark;
  }
}

/// The same beside a component that follows one of it, with a time constant of 1e-4, and one of its own.
struct LateSpiralBeside {
  LateSpiral spiral;
  Sizes sizes() const { return {.nx = 4}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    spiral.residual(p, r);
    r.x[2] = -1e4 * (p.x[2] - p.x[0]) - p.k[2];
    r.x[3] = -5.0 * (p.x[3] - 3.0) - p.k[3];
  }
};

TEST(UnstableRest, ComponentsThatAreDrivenNeedNoShortSteps) {
  const LateSpiralBeside problem{{1, 3, 20}};
  const double t = 2 * problem.spiral.turn();
  const MeasuredRun run = measuredRun(problem, startOf(problem, {.x = {1, 2, 1, 4}}), t, embedded(1e-4));
  EXPECT_NEAR(std::hypot(run.second.state.x[0] - 1, run.second.state.x[1] - 1), 1, 0.3);
  EXPECT_TRUE(run.bar.remark.empty()) << run.bar.remark;
  EXPECT_LT(run.steps, 3000);
}

// An oscillation of 1500 / s through a decay of 1.6 s takes 19 000 steps of 1/8 of its time constant. Its growth alone
// is followed then.
TEST(UnstableRest, ARemarkTellsOfADecayThatIsTooLong) {
  const LateSpiral problem{10, 1500, 20};
  const MeasuredRun run = measuredRun(problem, problem.start(), 2 * problem.turn(), embedded(1e-3));
  EXPECT_NE(run.bar.remark.find("takes too many steps"), std::string::npos) << run.bar.remark;
  EXPECT_GT(run.steps, 13000) << "10 000 through the decay, and those of the growth";
}

// x - 1 = e^(10 sin t) over ten periods, and then a decay to nothing within one unit of time.
TEST(UnstableRest, ADecayToNothingAfterGrowthIsNoReasonForARemark) {
  static constexpr double kEnd = 20 * M_PI;
  const FirstOrder problem{[]<class T>(const Point<T>& p) {
    using std::cos;
    return (p.t > kEnd ? T(-50.0) : T(10.0 * cos(p.t))) * (p.x[0] - 1.0);
  }};
  const MeasuredRun run = measuredRun(problem, startOf(problem, {.x = {2}}), kEnd + 1, embedded(1e-3));
  EXPECT_NEAR(run.second.state.x[0], 1, 1e-4);
  EXPECT_TRUE(run.bar.remark.empty()) << run.bar.remark;
}

// x decays to nothing around 1, is moved by a push at t = 3, decays by e^-15 from there on, and grows again.
TEST(UnstableRest, APushAfterADecayToNothingIsNoReasonForARemark) {
  const FirstOrder problem{[](const auto& p) {
    using std::exp;
    using std::tanh;
    const auto from_push = 10.0 * (p.t - 3.0);
    const auto growth = 10.0 * tanh(10.0 * (p.t - 4.5)) - 20.0 * (1.0 - tanh(10.0 * (p.t - 2.5)));
    return growth * (p.x[0] - 1.0) + 5.0 * exp(-from_push * from_push);
  }};
  const MeasuredRun run = measuredRun(problem, startOf(problem, {.x = {2}}), 6, embedded(1e-3));
  EXPECT_GT(std::abs(run.second.state.x[0] - 1), 0.1) << "it is pushed from the rest";
  EXPECT_EQ(run.bar.remark, "");
}

// Two equal eigenvalues: each motion has an eigenvector of its own.
TEST(UnstableRest, EqualEigenvaluesAreKeptApart) {
  const LateSpiral problem{0.3, 0, 12};
  const auto start = startOf(problem, {.x = {1, 2}});
  const MeasuredRun run = measuredRun(problem, start, 2 * problem.turn(), embedded(1e-3));
  EXPECT_NEAR(run.second.state.x[1], 2, 0.3);
  EXPECT_TRUE(run.bar.remark.empty()) << run.bar.remark;
}

TEST(UnstableRest, ARemarkTellsOfADecayBelowRoundOff) {
  for (const double frequency : {0.0, 3.0, 30.0}) {
    const LateSpiral problem{1, frequency, 60};
    const auto remarkAt = [&](double t) { return measuredRun(problem, problem.start(), t, embedded(1e-3)).bar.remark; };
    EXPECT_NE(remarkAt(2 * problem.turn()).find("nearer to it than round-off"), std::string::npos) << frequency;
    EXPECT_EQ(remarkAt(1.5 * problem.turn()), "") << frequency << ": it has not grown to the tolerance";
  }
}

TEST(UnstableRest, ARemarkTellsOfOneThatIsTooFast) {
  const Spiral problem{1, 1e6};
  const auto run = measuredRun(problem, problem.start(), 15, embedded(1e-4));
  EXPECT_NE(run.bar.remark.find("unstable rest at t = "), std::string::npos) << run.bar.remark;
  EXPECT_NE(run.bar.remark.find("too many steps"), std::string::npos) << run.bar.remark;
}

// The same equations backward in growth: long steps, once.
TEST(UnstableRest, AStableOneCostsNothing) {
  const Spiral problem{-1, 100};
  const auto run = measuredRun(problem, problem.start(), 15, embedded(1e-4));
  EXPECT_LT(run.steps, 100);
  EXPECT_TRUE(run.bar.remark.empty()) << run.bar.remark;
  EXPECT_LT(run.bar.tolerances, 1);
}

}  // namespace
}  // namespace irk::test
