// The defect of a step between its stages: its value, its size on smooth motions, and what it finds.
#include "core/estimates/defect.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "core/derivatives/consistent_start.h"
#include "core/estimates/step_attempt.h"
#include "tests/core/one_step.h"

namespace irk::test {
namespace {

/// x' = lambda x + t^4 and u'' = -9 u + t^3.
struct ForcedPair {
  double lambda = -3;
  Sizes sizes() const { return {.nu = 1, .nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -9.0 * p.u[0] + p.t * p.t * p.t - p.a[0];
    r.x[0] = lambda * p.x[0] + p.t * p.t * p.t * p.t - p.k[0];
  }
};

/// One step and its defect.
template <class P>
struct SolvedStepOf : OneStep<P> {
  SolvedStepOf(const P& problem, const char* method, double tol)
      : OneStep<P>(problem, method, embedded(tol), adaptive(tol).tolerances),
        defect(this->estimate, this->scheme, this->system->sizes(), Defect<double>::Start::kLeaveOut,
               this->options.step.looks),
        points(this->scheme, this->options.step.looks) {}

  void solve(State<double> start, double h) {
    ConsistentStart<double> consistent(*this->system, this->options.derivatives, false, &this->counters);
    ASSERT_EQ(consistent.apply(start).outcome, Outcome::kSuccess);
    defect.begin(h);
    ASSERT_EQ(OneStep<P>::solve(start, h), Outcome::kSuccess);
  }

  Defect<double> defect;
  MovingPoints<double> points;
};

// Lagrange's polynomial through the stages, and its integrals by Gauss's rule with many points.
double lagrangeAt(const Vec<double>& c, Index j, double x) {
  double product = 1;
  for (Index i = 0; i < c.size(); ++i) {
    if (i != j) product *= (x - c[i]) / (c[j] - c[i]);
  }
  return product;
}
double integralTo(const std::function<double(double)>& f, double to) {
  const Tableau<double> rule = makeTableau<double>("gauss_8");  // exact for the polynomials here
  double sum = 0;
  for (Index i = 0; i < 8; ++i) sum += to * rule.b[i] * f(to * rule.c[i]);
  return sum;
}

// e(theta) = h mu |filter^-1 r|, written out for two uncoupled equations:
//   x: (lambda X + t^4 - K) / (1 - h mu lambda),   u: (-9 U + t^3 - A) / (1 + 9 h^2 mu^2).
TEST(Defect, IsTheFilteredResidualOfTheContinuousSolution) {
  for (const char* method : {"radau_iia_3", "lobatto_iiic_4", "gauss_3"}) {
    const double tol = 1, h = 0.4;
    SolvedStepOf<ForcedPair> step({}, method, tol);
    const auto start = startOf(ForcedPair{}, {.u = {0.3}, .v = {-0.2}, .x = {0.7}});
    step.solve(start, h);
    const Mat<double>& W = step.stepper.stages().W;
    const Vec<double>& c = step.scheme.c;
    for (const std::int64_t i : {0, 1, 2, 7}) {
      const double theta = step.points.place(i);
      const auto inside = [&](Index row, double x) {
        double sum = 0;
        for (Index j = 0; j < c.size(); ++j) sum += W(row, j) * lagrangeAt(c, j, x);
        return sum;
      };
      const auto velocity = [&](double x) {
        return start.v[0] + h * integralTo([&](double y) { return inside(0, y); }, x);
      };
      const double U = start.u[0] + h * integralTo(velocity, theta);
      const double X = start.x[0] + h * integralTo([&](double y) { return inside(1, y); }, theta);
      const double t = theta * h, mu = step.estimate.mu();
      const double x = (-3 * X + std::pow(t, 4) - inside(1, theta)) / (1 + 3 * h * mu);
      const double a = (-9 * U + std::pow(t, 3) - inside(0, theta)) / (1 + 9 * h * h * mu * mu);
      // The norm: RMS over u, v, x.
      const auto weight = [&](double y) { return tol + tol * std::abs(y); };
      const double du = h * h * mu * mu * a / weight(start.u[0]), dv = h * mu * a / weight(start.v[0]),
                   dx = h * mu * x / weight(start.x[0]);
      const double expected = std::sqrt((du * du + dv * dv + dx * dx) / 3);
      const auto result = step.defect.at(i, step.from, step.stepper.stages());
      ASSERT_EQ(result.outcome, Outcome::kSuccess);
      EXPECT_NEAR(result.error, expected, 1e-8 * expected + 1e-9) << method << " theta " << theta;
    }
  }
}

// Where the solution is a polynomial that the stages reproduce, there is nothing between them: x' = 4 t^3 has degree 3.
TEST(Defect, OfAPolynomialIsZero) {
  const FirstOrder quartic{[](const auto& p) { return 4.0 * p.t * p.t * p.t; }};
  for (const char* method : {"radau_iia_4", "gauss_4", "lobatto_iiic_4"}) {
    SolvedStepOf<decltype(quartic)> step(quartic, method, 1e-12);
    step.solve(State<double>(quartic.sizes()), 1);
    const auto result = step.defect.largest(step.from, step.stepper.stages(), step.to);
    ASSERT_EQ(result.outcome, Outcome::kSuccess);
    EXPECT_LT(result.error, 0.1) << method;
  }
}

// It is no second estimate: on a smooth motion it stays below the embedded one, which is the defect at the start.
TEST(Defect, OfASmoothMotionIsBelowTheEmbeddedEstimate) {
  for (const char* method : {"radau_iia_2", "radau_iia_3", "radau_iia_5", "radau_iia_7", "gauss_3", "lobatto_iiic_4"}) {
    SolvedStepOf<Oscillators> step({}, method, 1e-10);
    step.solve(oscillatorsStart<double>(), 0.05);
    const auto estimate = step.estimate.evaluate(step.from, step.stepper.stages(), 1e300);
    const auto between = step.defect.largest(step.from, step.stepper.stages(), step.to);
    EXPECT_LT(between.error, estimate.error) << method;
    EXPECT_GT(between.error, 1e-3 * estimate.error) << method;
  }
}

// The twin: every point filtered by itself. Two uncoupled equations: what no row shows, no error shows.
TEST(Defect, OfAStepIsTheLargestOfItsPoints) {
  for (const char* method : {"radau_iia_3", "lobatto_iiic_4", "gauss_3"}) {
    SolvedStepOf<ForcedPair> step({}, method, 1e-6);
    const auto start = startOf(ForcedPair{}, {.u = {0.3}, .v = {-0.2}, .x = {0.7}});
    step.solve(start, 0.4);
    const auto together = step.defect.largest(step.from, step.stepper.stages(), step.to);
    ASSERT_EQ(together.outcome, Outcome::kSuccess);
    double largest = 0;
    const std::int64_t solves = step.counters.filter_solves;
    for (std::int64_t i = 0; i < step.points.period(); ++i) {
      largest = std::max(largest, step.defect.at(i, step.from, step.stepper.stages()).error);
    }
    EXPECT_GE(step.counters.filter_solves - solves, step.points.period());
    if (std::string(method) == "gauss_3") {
      EXPECT_GE(together.error, largest);  // it looks at the end as well
    } else {
      EXPECT_DOUBLE_EQ(together.error, largest);
    }
    EXPECT_LT(together.error, 10 * largest);
  }
}

// Gauss has no stage at the step's end. There the defect is as large as at the start, which is left out here, and
// larger than at any point between the stages.
TEST(Defect, LooksAtTheEndWhereNoStageIs) {
  const double h = 0.4;
  SolvedStepOf<ForcedPair> step({}, "gauss_3", 1);
  const auto start = startOf(ForcedPair{}, {.u = {0.3}, .v = {-0.2}, .x = {0.7}});
  step.solve(start, h);
  const Mat<double>& W = step.stepper.stages().W;
  Vec<double> w = Vec<double>::Zero(2);
  for (Index j = 0; j < 3; ++j) w += lagrangeAt(step.scheme.c, j, 1) * W.col(j);
  const double mu = step.estimate.mu();
  const double x = (-3 * step.to.x[0] + std::pow(h, 4) - w[1]) / (1 + 3 * h * mu);
  const double a = (-9 * step.to.u[0] + std::pow(h, 3) - w[0]) / (1 + 9 * h * h * mu * mu);
  const auto weight = [](double y) { return 1 + std::abs(y); };
  const double du = h * h * mu * mu * a / weight(start.u[0]), dv = h * mu * a / weight(start.v[0]),
               dx = h * mu * x / weight(start.x[0]);
  const double at_end = std::sqrt((du * du + dv * dv + dx * dx) / 3);
  double inside = 0;
  for (std::int64_t i = 0; i < step.points.period(); ++i) {
    inside = std::max(inside, step.defect.at(i, step.from, step.stepper.stages()).error);
  }
  ASSERT_GT(at_end, 1.01 * inside) << "the test shows nothing";
  const auto result = step.defect.largest(step.from, step.stepper.stages(), step.to);
  EXPECT_NEAR(result.error, at_end, 1e-6 * at_end);
}

struct CountedPair {
  long* evaluated;
  ForcedPair pair = {};
  Sizes sizes() const { return pair.sizes(); }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    ++*evaluated;
    pair.residual(p, r);
  }
};

// A step that is solved again to its switch lies inside the one that was looked at.
TEST(Defect, LooksOnceAtAnIntervalThatItHasSeen) {
  long evaluated = 0;
  SolvedStepOf<CountedPair> step(CountedPair{&evaluated}, "radau_iia_3", 1e-6);
  step.solve(startOf(step.system->sizes(), {.u = {0.3}, .x = {0.7}}), 0.01);
  const auto pointsOf = [&] {
    const long before = evaluated;
    const auto result = step.defect.largest(step.from, step.stepper.stages(), step.to);
    EXPECT_EQ(result.outcome, Outcome::kSuccess);
    EXPECT_LT(result.error, 1);
    return evaluated - before;
  };
  const long all = pointsOf();
  EXPECT_GE(all, step.options.step.looks);
  EXPECT_EQ(pointsOf(), 1);
  step.defect.forget();
  EXPECT_EQ(pointsOf(), all);
}

TEST(Defect, LooksAtMorePointsOfALongerStep) {
  EXPECT_EQ(looksInStep(100, 0.001, 1, 55), 1);
  EXPECT_EQ(looksInStep(100, 0.035, 1, 55), 4);
  EXPECT_EQ(looksInStep(100, 1, 1, 55), 55);
  EXPECT_EQ(looksInStep(1000, 0.035, 1, 610), 35);
}

// Also across the end of a period.
TEST(MovingPoints, LeaveNoGapAboveTwoPartsOfTheirNumber) {
  const Scheme<double> scheme(makeTableau<double>("radau_iia_3"));
  for (const std::int64_t looks : {100, 1000}) {
    const MovingPoints<double> points(scheme, looks);
    EXPECT_EQ(points.period(), looks == 100 ? 144 : 1597);
    for (const int n : {2, 5, 13, 21, 34, 55, 144, 610, 1597}) {
      if (n > points.period()) continue;
      for (const std::int64_t first : {0, 17, 50, 1000}) {
        std::vector<double> places{0, 1};
        for (int i = 0; i < n; ++i) places.push_back(points.place(first + i));
        std::sort(places.begin(), places.end());
        double gap = 0;
        for (std::size_t i = 1; i < places.size(); ++i) gap = std::max(gap, places[i] - places[i - 1]);
        EXPECT_LE(gap, 2.0 / n) << n << " from " << first;
        EXPECT_GT(places[1], 0);
      }
    }
  }
}

}  // namespace
}  // namespace irk::test
