// Positions at which the constraints become dependent: branches of the motion meet, and no run may choose one silently.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "core/derivatives/constraint_frame.h"
#include "tests/core/support.h"
#include "tests/refusal.h"

namespace irk::test {
namespace {

/// A bead of mass 1 on a wire f(x, y) = 0 in a plane, pulled by a force.
template <class Wire>
struct Bead {
  Wire wire{};
  double fy = 0;
  Sizes sizes() const { return {.nu = 2, .nz = 1, .constraints = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const auto gradient = wire.gradient(p.u[0], p.u[1]);
    r.u[0] = -p.a[0] - gradient.first * p.z[0];
    r.u[1] = -p.a[1] + fy - gradient.second * p.z[0];
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    g[0] = wire.f(u[0], u[1]);
  }
};
/// x^4 - x^2 + y^2 = 0, an eight with its crossing at 0.
struct Eight {
  template <class T>
  T f(const T& x, const T& y) const {
    return (x * x - 1.0) * x * x + y * y;
  }
  template <class T>
  std::pair<T, T> gradient(const T& x, const T& y) const {
    return {(4.0 * x * x - 2.0) * x, 2.0 * y};
  }
};
/// x y = e: two lines that cross for e = 0, else a smooth wire.
struct Cross {
  double e = 0;
  template <class T>
  T f(const T& x, const T& y) const {
    return x * y - e;
  }
  template <class T>
  std::pair<T, T> gradient(const T& x, const T& y) const {
    return {y, x};
  }
};
struct Setting {
  Formulation formulation;
  IntegratorOptions options;
  bool family;
};
template <class F>
void forEachSetting(F&& f) {
  for (const Formulation formulation : {Formulation::kIndex3, Formulation::kIndex2, Formulation::kIndex2Projected,
                                        Formulation::kGgl, Formulation::kIndex1, Formulation::kFirstOrder}) {
    for (const double tol : {1e-4, 1e-6, 1e-8, 1e-10}) {
      for (const Setting& c : {Setting{formulation, adaptive(tol), false}, Setting{formulation, embedded(tol), false},
                               Setting{formulation, variable(tol), true}}) {
        SCOPED_TRACE(testing::Message() << idOf(formulation) << " " << tol << " " << idOf(c.options.step.estimate)
                                        << (c.family ? " variable" : ""));
        f(c);
      }
    }
  }
}

template <class P>
Solution<double> runOver(const P& problem, const State<double>& start, double t_end, const Setting& c) {
  const auto methods = c.family ? makeMethods<double>("radau_iia_5", 13, 5) : makeTableau<double>("radau_iia_5");
  return Integrator<double>(makeSystem<double>(problem, {c.formulation}), methods, c.options).integrate(start, t_end);
}

State<double> beadAt(double x, double y, double vx, double vy) {
  return startOf({.nu = 2, .nz = 1, .constraints = 1}, {.u = {x, y}, .v = {vx, vy}});
}

void expectSingular(const Solution<double>& s, double t) {
  EXPECT_EQ(name(s.outcome), "singular") << s.detail;
  const std::string beginning = "singular position at t = ";
  ASSERT_EQ(s.detail.substr(0, beginning.size()), beginning) << s.detail;
  EXPECT_NEAR(std::stod(s.detail.substr(beginning.size())), t, 0.01) << s.detail;
  EXPECT_TRUE(contains(s.detail, "constraint 0"));
  EXPECT_LT(s.state.t, t + 1e-3) << "the state is the last one before";
}

// The bead has speed 1, so that it reaches the crossing after the length of a quarter of the eight, from (1, 0) to (0,
// 0): x = cos p, y = sin p cos p.
TEST(SingularPositions, NoRunPassesTheCrossingOfAnEight) {
  double length = 0;
  constexpr int kPanels = 2000;  // midpoint rule: exact to round-off for this periodic integrand
  for (int i = 0; i < kPanels; ++i) {
    const double p = (i + 0.5) * std::numbers::pi / 2 / kPanels;
    length += std::hypot(std::sin(p), std::cos(2 * p)) * std::numbers::pi / 2 / kPanels;
  }
  forEachSetting([&](const Setting& c) {
    // More than 100 000 steps before it, and no end.
    if (c.formulation == Formulation::kGgl && c.options.tolerances.rtol < 1e-9) return;
    expectSingular(runOver(Bead<Eight>{}, beadAt(1, 0, 0, 1), 5, c), length);
  });
}

TEST(SingularPositions, NoRunPassesTheCrossingOfTwoWires) {
  forEachSetting([&](const Setting& c) {
    expectSingular(runOver(Bead<Cross>{{}, 1}, beadAt(0.7, 0, -1, 0), 2, c), 0.7);
  });
}

// The wire turns by 90 degrees within its smallest radius, about sqrt(2 e) = 0.014. Speed 1: from (1, e) to the vertex
// and, by symmetry, as long again to (e, 1).
TEST(SingularPositions, ASharpBendIsNoCrossing) {
  constexpr double e = 1e-4;
  const auto speed = [](double s) {  // x = e^s: |d(x, e / x)/ds|
    return std::hypot(std::exp(s), e * std::exp(-s));
  };
  const double end = std::log(std::sqrt(e));
  constexpr int kPanels = 20000;
  double length = 0;
  for (int i = 0; i < kPanels; ++i) length += speed(end * (i + 0.5) / kPanels) * -end / kPanels;
  forEachSetting([&](const Setting& c) {
    if (c.options.tolerances.rtol > 1e-8 || c.formulation == Formulation::kGgl) return;
    const double slow = std::hypot(1, e);
    const Solution<double> s = runOver(Bead<Cross>{{e}}, beadAt(1, e, -1 / slow, e / slow), 2 * length, c);
    EXPECT_EQ(s.outcome, Outcome::kSuccess) << s.detail;
    EXPECT_NEAR(s.state.u[0], e, 1e-5);
    EXPECT_NEAR(s.state.u[1], 1, 1e-5);
  });
}

// Steps over large parts of a turn: the gradient of a circle turns with them, but never at once.
TEST(SingularPositions, LongStepsOverARegularMotionAreNoCrossing) {
  const auto start = startOf(CartesianPendulum{}, {.u = {0, -1}, .v = {7, 0}});  // turns over
  forEachSetting([&](const Setting& c) {
    const Solution<double> s = runOver(CartesianPendulum{}, start, 10, c);
    EXPECT_NE(s.outcome, Outcome::kSingular) << s.detail;
  });
}

/// A pendulum with its constraint written twice, and a third one that is independent.
struct Repeated {
  Sizes sizes() const { return {.nu = 3, .nz = 3, .constraints = 3}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T force = p.z[0] + 3.0 * p.z[1];
    r.u[0] = -p.a[0] - p.u[0] * force;
    r.u[1] = -p.a[1] - 9.81 - p.u[1] * force;
    r.u[2] = -p.a[2] - p.z[2];
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    g[0] = (u[0] * u[0] + u[1] * u[1] - 1.0) * 0.5;
    g[1] = (u[0] * u[0] + u[1] * u[1] - 1.0) * 1.5;
    g[2] = u[2];
  }
};

TEST(SingularPositions, DependentConstraintsAtTheStartAreSaidByNumber) {
  const auto start = startOf(Repeated{}, {.u = {0.6, -0.8, 0}});
  for (const Formulation f : {Formulation::kIndex3, Formulation::kIndex2, Formulation::kGgl, Formulation::kIndex1}) {
    const auto s = integrate<double>(Repeated{}, start, 1, makeTableau<double>("radau_iia_5"), adaptive(1e-6), f);
    EXPECT_EQ(name(s.outcome), "singular") << idOf(f);
    EXPECT_TRUE(contains(s.detail, "the constraints have rank 2 of 3 at the start"));
  }
}

// The rest of a Newton step at the vertex of x y = e is 1/4, whatever e is; on the circle of radius r it is that of the
// square root: g = (r^2 - 1) / 2, step (r^2 - 1) / (2 r), rest (r^2 - 1) / (4 r^2).
TEST(ConstraintFrames, TheRestOfANewtonStepIsThatOfClosedForms) {
  for (const double e : {1e-2, 1e-6, 1e-12}) {
    const auto system = makeSystem<double>(Bead<Cross>{{0}, 0}, {});
    ConstraintFrames<double> frames(*system, {});
    ConstraintFrame frame = frames.make();
    const State<double> s = beadAt(std::sqrt(e), std::sqrt(e), 0, 0);
    frames.evaluate(s, 0, s.u, frame);
    ASSERT_TRUE(frame.regular());
    EXPECT_NEAR(frames.newtonRest(frame), 0.25, 1e-6) << e;
  }
  const auto pendulum = makeSystem<double>(CartesianPendulum{}, {});
  ConstraintFrames<double> frames(*pendulum, {});
  ConstraintFrame frame = frames.make(), turned_frame = frame;
  for (const double r : {1.001, 1.1, 2.0}) {
    State<double> s = beadAt(0.6 * r, -0.8 * r, 0, 0);
    frames.evaluate(s, 0, s.u, frame);
    EXPECT_NEAR(frames.newtonRest(frame), (r * r - 1) / (4 * r * r), 1e-8) << r;
    Mat<double> scratch(1, 1);
    s.u << std::cos(2.0), std::sin(2.0);
    frames.evaluate(s, 0, s.u, turned_frame);
    EXPECT_NEAR(turned(frame, turned_frame, scratch), 0.6 * std::cos(2.0) - 0.8 * std::sin(2.0), 1e-14);
  }
}

}  // namespace
}  // namespace irk::test
