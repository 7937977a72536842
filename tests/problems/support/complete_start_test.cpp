// Starts whose rates follow from the equations.
#include <gtest/gtest.h>

#include "irk/misuse.h"
#include "irk/scene_file.h"
#include "tests/refusal.h"

namespace irk {
namespace {

// A capacitor between two nodes: its matrix in front of k is singular, and the sum of the rows is an algebraic
// equation.
struct Circuit {
  Sizes sizes() const { return {.nu = 0, .nx = 2, .nz = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = p.k[1] - p.k[0] + 1 - p.x[0];
    r.x[1] = p.k[0] - p.k[1] - p.x[1];
  }
};

template <class Real>
Scene<Real> circuit(double x0, double x1) {
  Scene<Real> scene;
  setProblem(scene, Circuit{});
  scene.start.x << Real(x0), Real(x1);
  return scene;
}

TEST(CompleteStart, TakesTheLeastRatesOfASingularMatrix) {
  auto scene = circuit<double>(0.25, 0.75);
  completeStart(scene);
  EXPECT_NEAR(scene.start.w[0], 0.375, 1e-14);
  EXPECT_NEAR(scene.start.w[1], -0.375, 1e-14);
  auto digits = circuit<BigFloat>(0.25, 0.75);
  completeStart(digits);
  EXPECT_LT(abs(BigFloat(digits.start.w[0] - 0.375)), BigFloat("1e-48"));
}

TEST(CompleteStart, RefusesAStartThatTheEquationsContradict) {
  auto scene = circuit<double>(0.5, 0.75);
  const auto message = refusal([&] { completeStart(scene); });
  EXPECT_TRUE(contains(message, "its start")) << " (0.5 + 0.75 is not 1)";
}

// Its residual would read beyond the end.
TEST(CompleteStart, RefusesAStartOfAnotherSize) {
  for (const Index size : {1, 3}) {
    auto scene = circuit<double>(0.25, 0.75);
    scene.start.x.setZero(size);
    const auto message = refusal([&] { completeStart(scene); });
    EXPECT_EQ(message, "start: x: " + std::to_string(size) + " numbers, 2 are expected");
    EXPECT_EQ(refusal([&] { completeStart(scene, {}); }), message);
  }
}

// Two coordinates on a circle of radius `m`.
template <class Real>
struct OnCircle {
  double m;
  Sizes sizes() const { return {.nu = 2, .nz = 1, .constraints = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    for (Index i = 0; i < 2; ++i) r.u[i] = -p.a[i] - p.u[i] * p.z[0];
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    g[0] = u[0] * u[0] + u[1] * u[1] - m * m;
  }
};

TEST(CompleteStart, JudgesConstraintsRelativeToTheScale) {
  for (const double m : {1e-3, 1.0, 1e6}) {
    const auto complete = [m](double off) {
      Scene<double> scene;
      setProblem(scene, OnCircle<double>{m});
      setComponents(scene, {{"x", "m", m, m}, {"y", "m", m, m}}, {}, {{"lambda"}});
      scene.start.u << 0.6 * m * (1 + off), 0.8 * m * (1 + off);
      completeStart(scene);
    };
    EXPECT_NO_THROW(complete(1e-12)) << m;
    EXPECT_THROW(complete(1e-3), Misuse) << m;
  }
}

}  // namespace
}  // namespace irk
