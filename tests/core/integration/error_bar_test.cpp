// The error bar of a result: a second integration with another method measures its error.
#include "irk/error_bar.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "tests/core/error_bar_run.h"

namespace irk::test {
namespace {

/// y' = L (y - cos t) - sin t with the solution cos t: errors grow by e^L per unit of time. Second order in u, beside
/// it, with the solution u = sin t.
struct GrowingError {
  double L;
  Sizes sizes() const { return {.nu = 1, .nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    r.u[0] = -p.u[0] - p.a[0];
    r.x[0] = L * (p.x[0] - cos(p.t)) - sin(p.t) - p.k[0];
  }
  State<double> start() const { return startOf(sizes(), {.v = {1}, .x = {1}}); }
};

// With growth the error is far above the tolerance, without it below. The bar is right for both.
TEST(ErrorBar, IsTheErrorOfTheResult) {
  for (const double L : {-1.0, 5.0, 10.0}) {
    for (const double tol : {1e-4, 1e-7}) {
      for (const IntegratorOptions& options : {adaptive(tol), embedded(tol)}) {
        const GrowingError problem{L};
        const double t_end = 1.5;
        const MeasuredRun m = measuredRun(problem, problem.start(), t_end, options);
        const double error = std::abs(m.first.state.x[0] - std::cos(t_end));
        EXPECT_LE(error, 3 * (m.bar.x[0] + tol)) << "L " << L << " tol " << tol;
        if (error > tol) {
          EXPECT_LE(m.bar.x[0], 3 * error) << "L " << L << " tol " << tol;
        }
        const double error_u = std::abs(m.first.state.u[0] - std::sin(t_end));
        EXPECT_LE(error_u, 3 * (m.bar.u[0] + tol));
        // One tolerance of x is tol (1 + |cos t_end|).
        if (L > 1) {
          EXPECT_NEAR(m.bar.tolerances, m.bar.x[0] / (tol * (1 + std::abs(m.second.state.x[0]))), 1e-6);
          EXPECT_EQ(m.bar.worst, 2);  // u, v, x
        }
      }
    }
  }
}

// In the paper's norm a tolerance is atol, whatever the magnitude and the value of the component.
TEST(ErrorBar, CountsToleranceByTheNorm) {
  const GrowingError problem{-1};
  IntegratorOptions options = embedded(1e-4);
  options.tolerances.rtol = 1e-2;
  State<double> result = problem.start();
  result.t = 1.5;
  const auto tolerances = [&](NormKind norm, double scale) {
    options.tolerances.norm = norm;
    auto other = secondOf(makeSystem<double>(problem), options);
    Solution<double> second;
    return measureErrorBar(result, other, problem.start(), options.tolerances, Vec<double>::Constant(3, scale), second)
        .tolerances;
  };
  // The errors of the start as a result: sin 1.5 of u, 1 - cos 1.5 of v.
  EXPECT_NEAR(tolerances(NormKind::kAbsolute, 1e-9) / (std::sin(1.5) / 1e-4), 1, 0.01);
  EXPECT_NEAR(tolerances(NormKind::kAbsolute, 1e3) / (std::sin(1.5) / 1e-4), 1, 0.01);
  // In the mixed norm of u as well, which is 0 in the result.
  EXPECT_NEAR(tolerances(NormKind::kMixed, 1) / (std::sin(1.5) / 1e-4), 1, 0.01);
  EXPECT_NEAR(tolerances(NormKind::kMixed, 1e3) / (std::sin(1.5) / 1e-1), 1, 0.01);
}

// A wrong result that is large, whichever of the two it is, is not within 1 / rtol tolerances of itself.
TEST(ErrorBar, CountsTolerancesOfTheSmallerResult) {
  const GrowingError problem{-1};
  const IntegratorOptions options = embedded(1e-2);
  const double exact = std::sin(1.5);
  for (const double first : {1e8, exact / 1e8}) {
    State<double> result = problem.start();
    result.t = 1.5;
    result.u[0] = first;
    auto other = secondOf(makeSystem<double>(problem), options);
    Solution<double> second;
    const ErrorBar bar =
        measureErrorBar(result, other, problem.start(), options.tolerances, Vec<double>::Constant(3, 1e-12), second);
    const double smaller = std::min(first, exact), tolerance = 1e-2 * (1e-12 + smaller);
    EXPECT_NEAR(bar.tolerances * tolerance / std::abs(first - exact), 1, 1e-2) << first;
    EXPECT_GT(bar.tolerances, 1e8) << first;
  }
}

TEST(ErrorBar, IsUnknownIfTheSecondIntegrationFails) {
  const FirstOrder until_one{[]<class T>(const Point<T>& p) {
    return (p.t > T(1) ? std::numeric_limits<double>::quiet_NaN() : -1.0) * p.x[0];
  }};
  const auto start = startOf(until_one, {.x = {1}}), result = startOf(until_one, {.t = 2});
  const auto options = adaptive(1e-4);
  auto second = secondOf(makeSystem<double>(until_one), options);
  Solution<double> other;
  const ErrorBar bar = measureErrorBar(result, second, start, options.tolerances, {}, other);
  EXPECT_FALSE(bar.known());
  EXPECT_TRUE(std::isnan(bar.tolerances));
  ASSERT_EQ(bar.x.size(), 1);
  EXPECT_TRUE(std::isnan(bar.x[0]));
  EXPECT_NE(bar.problem.find("the integration that measures it"), std::string::npos) << bar.problem;
}

// It is used as soon as a component of the result is not finite.
TEST(ErrorBar, OfAResultThatIsNoNumberIsInfinite) {
  const GrowingError problem{-1};
  const auto options = adaptive(1e-4);
  auto second = secondOf(makeSystem<double>(problem), options);
  State<double> result = problem.start();
  result.t = 1;
  result.u[0] = std::numeric_limits<double>::quiet_NaN();
  Solution<double> other;
  const ErrorBar bar = measureErrorBar(result, second, problem.start(), options.tolerances, {}, other);
  EXPECT_TRUE(std::isinf(bar.tolerances));
  EXPECT_EQ(bar.worst, 0);
}

/// A level that rises and falls by `width` in one second each, and the time for which it rises. The width is a hundred
/// units of the level's round-off, so that a switch is known to some hundredths of a second only.
struct NarrowControl {
  double level = 1e6, width = 1e-8;
  Sizes sizes() const { return {.nx = 2, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = width * (2.0 * p.d[0] - 1.0) - p.k[0];
    r.x[1] = p.d[0] - p.k[1];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = p.d[0] > T(0.5) ? T(p.x[0] - (level + width / 2)) : T(level - width / 2 - p.x[0]);
  }
  template <class T>
  void onSwitch(Index, const Point<T>& p, T* d) const {
    d[0] = 1.0 - p.d[0];
  }
  State<double> start() const { return startOf(sizes(), {.x = {level, 0}, .d = {1}}); }
};

/// A measuring tank that fills by one unit per second and is emptied when it holds a tenth.
struct MeasuringTank {
  Sizes sizes() const { return {.nx = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = 1 - p.k[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = p.x[0] - 0.1;
  }
  template <class T>
  void onSwitch(Index, const Point<T>&, T*) const {}
  template <class T>
  void jump(Index, const Point<T>&, T*, T*, T* x) const {
    x[0] = T(0.0);
  }
};

// At t = 1e6 a time is known to 1e-10. Each emptying comes late by some of them, in both integrations, and what has
// flowed in since is lost, although the rates before and behind it are equal.
TEST(ErrorBar, CoversWhatJumpsMakeOfTheErrorOfTheirTime) {
  const auto start = startOf(MeasuringTank{}, {.t = 1e6});
  const double end = 1e6 + 50.0625;  // 500 tenths, and 5/8 of one
  const MeasuredRun m = measuredRun(MeasuringTank{}, start, end, embedded(1e-9));
  ASSERT_EQ(m.first.counters.switches, 500);
  EXPECT_LT(std::abs(m.first.state.x[0] - 0.0625), 3 * (m.bar.x[0] + 1e-9));
  // Each emptying adds one to five units of the round-off of its time, in which one unit per second flows in.
  const double by_switches = m.bar.x[0] - std::abs(m.first.state.x[0] - m.second.state.x[0]);
  const double least = 500 * 1e6 * 2.22e-16;
  EXPECT_GT(by_switches, 0.99 * least);
  EXPECT_LT(by_switches, 5.1 * least);
}

/// A carriage u' = 1 that passes a sensor at u = 7.3, which sees it for 1/200 of the way, and then brakes.
struct Carriage {
  Sizes sizes() const { return {.nu = 1, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -0.2 * p.d[0] - p.a[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    using std::exp;
    const T q = (p.u[0] - 7.3) / 0.03;
    g[0] = p.d[0] > T(0.5) ? T(-1.0) : T(exp(-q * q) - 0.5);
  }
  template <class T>
  void onSwitch(Index, const Point<T>&, T* d) const {
    d[0] = T(1.0);
  }
};

// One step would do without the sensor. The second integration has the closer looks.
TEST(ErrorBar, CoversASwitchThatASolverMayMiss) {
  const auto start = startOf(Carriage{}, {.v = {1}});
  const double rest = 10 - (7.3 - 0.03 * std::sqrt(std::log(2)));
  for (const double tol : {1e-3, 1e-9}) {
    const MeasuredRun m = measuredRun(Carriage{}, start, 10, embedded(tol));
    EXPECT_NEAR(m.second.state.u[0], 10 - 0.1 * rest * rest, 10 * tol);
    EXPECT_LE(std::abs(m.first.state.u[0] - (10 - 0.1 * rest * rest)), 3 * (m.bar.u[0] + tol));
  }
}

// Both integrations switch early or late by round-off, which their distance need not show.
TEST(ErrorBar, CoversTheRoundOffOfSwitchingFunctions) {
  const NarrowControl control;
  constexpr double kEnd = 40.25, kRising = 20.25;  // from 0 to 0.5, then every other second
  const MeasuredRun m = measuredRun(control, control.start(), kEnd, embedded(1e-6));
  const double error = std::abs(m.first.state.x[1] - kRising);
  const double distance = std::abs(m.first.state.x[1] - m.second.state.x[1]);
  EXPECT_GT(error, 0.01) << "the test shows nothing";
  EXPECT_LT(error, 3 * m.bar.x[1]);
  // 40 switches, the time of each known to two units of the round-off of the level, which is eps times it.
  EXPECT_NEAR(m.bar.x[1], distance + 40 * 2 * 2.22e-16 * control.level / control.width, 0.3 * m.bar.x[1]);
}

// Numbers of 1e9 and more, as seconds since 1970, have few digits for a step.
TEST(ErrorBar, CoversTheTimeThatRoundingLoses) {
  const SecondOrder oscillator{[](const auto& p) { return -p.u[0]; }};
  int too_small = 0, runs = 0;
  std::vector<double> parts;  // bar over error
  for (const double t0 : {1e9, 1.7e9, 1e11, 1e12}) {
    for (double length = 1.3; length < 14; length += 0.17) {
      const auto start = startOf(oscillator, {.t = t0, .v = {1}});
      const double t_end = t0 + length;
      const MeasuredRun m = measuredRun(oscillator, start, t_end, embedded(1e-8));
      const double error =
          std::hypot(m.first.state.u[0] - std::sin(t_end - t0), m.first.state.v[0] - std::cos(t_end - t0));
      const double bar = std::hypot(m.bar.u[0], m.bar.v[0]);
      ++runs;
      too_small += error > 3 * (bar + 1e-8);
      if (error > 1e-8) parts.push_back(bar / error);
    }
  }
  ASSERT_GT(parts.size(), 100) << "the test shows nothing";
  std::sort(parts.begin(), parts.end());
  EXPECT_LE(parts[parts.size() / 2], 2);
  EXPECT_EQ(too_small, 0) << "of " << runs;
}

// A thousand tolerances, and 1e-9 beside it.
TEST(ErrorBar, LargestOfASuccess) {
  EXPECT_NEAR(largestErrorBar({1e-3, 1e-6}), 1000, 1e-5);
  EXPECT_NEAR(largestErrorBar({1e-13, 1e-12}), 2000, 1e-9);
}

TEST(ErrorBar, TheSecondIntegrationIsStricterAndKeepsWhatDescribesTheProblem) {
  IntegratorOptions first = adaptive(1e-5);
  first.tolerances.rtol = 1e-3;
  first.tolerances.norm = NormKind::kAbsolute;
  first.derivatives = DerivativeSource::kCentral;
  first.step.h_max = 0.25;
  first.step.max_steps = 77;
  first.threads = 3;
  first.jacobian = JacobianTerms::kNoMass;
  const IntegratorOptions second = independentOptions<double>(first);
  EXPECT_DOUBLE_EQ(second.tolerances.rtol, 1e-4);
  EXPECT_DOUBLE_EQ(second.tolerances.atol, 1e-6);
  EXPECT_EQ(second.tolerances.norm, NormKind::kAbsolute);
  EXPECT_EQ(second.derivatives, DerivativeSource::kAutomatic);
  EXPECT_EQ(second.step.h_max, 0.25);
  EXPECT_EQ(second.step.max_steps, 77);
  EXPECT_GT(second.step.looks, first.step.looks);
  EXPECT_EQ(second.threads, 3);
  EXPECT_EQ(second.jacobian, JacobianTerms::kFull);
  EXPECT_EQ(second.order, OrderControl::kVariable);
  // Not below round-off, and never looser than the first.
  const double eps = std::numeric_limits<double>::epsilon();
  EXPECT_DOUBLE_EQ(independentOptions<double>(adaptive(1e-13)).tolerances.rtol, 50 * eps);
  EXPECT_DOUBLE_EQ(independentOptions<double>(adaptive(5e-15)).tolerances.rtol, 5e-15);
  EXPECT_DOUBLE_EQ(independentOptions<double>(fixedSteps(0.1)).tolerances.rtol, 1e-10);
}

}  // namespace
}  // namespace irk::test
