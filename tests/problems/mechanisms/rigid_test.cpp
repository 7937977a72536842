// irk/rigid.h against finite differences of the energy and of the constraints, and against motions that are known.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "irk/integrator.h"
#include "irk/problem.h"
#include "irk/rigid.h"
#include "irk/tableaus.h"

namespace irk::test {
namespace {

using Vector3 = rigid::Vector<double>;
constexpr Vector3 kInertia{0.7, 1.3, 2.1};
constexpr rigid::Body kFirstBody{0}, kSecondBody{7};

/// Two bodies; the second one slides along a direction of the first one that is no axis, with an offset.
struct SlidingPair {
  Sizes sizes() const { return {.nu = 14, .nz = 7, .constraints = 7}; }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    const Vector3 n{0.6, 0, 0.8}, m1{0, 1, 0}, m2{-0.8, 0, 0.6};
    rigid::prismatic(u, g, 0, kFirstBody, Vector3{0.3, -0.2, 0.1}, kSecondBody, Vector3{-0.4, 0.5, 0.2}, n, m1, m2);
    g[5] = rigid::norm(u, 3);
    g[6] = rigid::norm(u, 10);
  }
};

Vec<double> constraintsOf(const Vec<double>& u) {
  Vec<double> g(7);
  SlidingPair{}.constraints(0.0, u, g);
  return g;
}

// Rotation by `angle` about an axis of length 1.
Eigen::Vector4d quaternion(double angle, const Vector3& axis) {
  const double s = std::sin(angle / 2);
  return {std::cos(angle / 2), s * axis.x, s * axis.y, s * axis.z};
}

/// The pair with equal attitudes, the second body at `along` the joint's direction and `across` it.
Vec<double> pairAt(double along, double across) {
  Vec<double> u(14);
  const Eigen::Vector4d e = quaternion(0.9, {0.36, 0.48, 0.8});
  u.segment(3, 4) = e;
  u.segment(10, 4) = e;
  u.head(3) << 1, 2, 3;
  const auto at =
      rigid::point(u, kFirstBody,
                   Vector3{0.3 + 0.6 * along - 0.8 * across + 0.4, -0.2 - 0.5, 0.1 + 0.8 * along + 0.6 * across - 0.2});
  u.segment(7, 3) << at.x, at.y, at.z;
  return u;
}

TEST(Rigid, TurnsAsARotationDoes) {
  Vec<double> e = quaternion(0.5, {0, 0, 1});
  const auto turned = rigid::turned(e, 0, Vector3{1, 2, 3});
  EXPECT_NEAR(turned.x, std::cos(0.5) - 2 * std::sin(0.5), 1e-15);
  EXPECT_NEAR(turned.y, std::sin(0.5) + 2 * std::cos(0.5), 1e-15);
  EXPECT_NEAR(turned.z, 3, 1e-15);
}

// d/dt dT/de' - dT/de of T = 2 e'^T G^T J G e', along e + t e' + t^2 e''/2, by central differences; also for |e| != 1.
TEST(Rigid, InertiaIsLagrangesOfTheEnergy) {
  const Vec<double> e{{0.7, -0.3, 0.5, 0.6}}, v{{0.4, 1.1, -0.8, 0.3}}, a{{-1.2, 0.6, 0.9, 1.4}};
  const auto energy = [](const Vec<double>& at, const Vec<double>& rate) {
    const auto w = rigid::bodyRate<double>(at, rate, 0);
    return 2 * (kInertia.x * w.x * w.x + kInertia.y * w.y * w.y + kInertia.z * w.z * w.z);
  };
  const double d = 1e-3;
  const auto slope = [&](const std::function<double(double)>& f) {
    return (8 * (f(d) - f(-d)) - (f(2 * d) - f(-2 * d))) / (12 * d);
  };
  const Point<double> point{0, {e.data(), 4}, {v.data(), 4}, {nullptr, 0}, {a.data(), 4}, {nullptr, 0}, {nullptr, 0}};
  double rows[4] = {0, 0, 0, 0};
  rigid::subtractTurningInertia(rows, point, 0, kInertia);
  for (Index i = 0; i < 4; ++i) {
    const Vec<double> unit = Vec<double>::Unit(4, i);
    const auto momentum = [&](double t) {
      const Vec<double> at = e + t * v + t * t / 2 * a, rate = v + t * a;
      return slope([&](double s) { return energy(at, rate + s * unit); });
    };
    const double expected = slope(momentum) - slope([&](double s) { return energy(e + s * unit, v); });
    EXPECT_NEAR(-rows[i], expected, 1e-8) << i;
  }
}

// addConstraintForces is G^T z, and addForce the gradient of f . point.
TEST(Rigid, ForcesAreGradients) {
  Vec<double> u = pairAt(0.7, 0.2), z{{1, -2, 3, 0.5, -1.5, 2.5, 0.25}}, none = Vec<double>::Zero(14), rows = none;
  u += 0.01 * Vec<double>::LinSpaced(14, -1, 1);
  const Point<double> point{
      0, {u.data(), 14}, {none.data(), 14}, {nullptr, 0}, {none.data(), 14}, {nullptr, 0}, {z.data(), 7}};
  const Rows<double> r{{rows.data(), 14}, {nullptr, 0}, {nullptr, 0}};
  rigid::addConstraintForces(SlidingPair{}, point, r);
  const Vector3 force{2, -1, 0.5}, at{0.1, 0.2, -0.3};
  rigid::addForce(r, point, kSecondBody, at, force);
  for (Index i = 0; i < 14; ++i) {
    const auto potential = [&](double s) {
      Vec<double> moved = u;
      moved[i] += s;
      return z.dot(constraintsOf(moved)) + rigid::dot(force, rigid::point(moved, kSecondBody, at));
    };
    EXPECT_NEAR(rows[i], (potential(1e-4) - potential(-1e-4)) / 2e-4, 1e-7) << i;
  }
}

TEST(Rigid, APrismaticJointSlidesAndDoesNothingElse) {
  for (const double along : {-2.0, 0.0, 0.7}) {
    EXPECT_LT(constraintsOf(pairAt(along, 0)).cwiseAbs().maxCoeff(), 1e-14) << along;
  }
  EXPECT_NEAR(constraintsOf(pairAt(0.7, 0.2)).cwiseAbs().maxCoeff(), 0.2, 1e-14);
  for (const Vector3& axis : {Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}}) {
    Vec<double> u = pairAt(0.7, 0);
    const auto turn = rigid::product<double>(u, 10, axis);
    for (Index k = 0; k < 4; ++k) u[10 + k] += 0.05 * turn[static_cast<std::size_t>(k)];
    EXPECT_GT(constraintsOf(u).segment(2, 3).cwiseAbs().maxCoeff(), 0.05) << axis.x << axis.y << axis.z;
  }
}

/// A body that slides without friction on a rail of the ground, 30 degrees below the horizontal.
struct OnARail {
  static constexpr Vector3 along() { return {0.8660254037844386, 0, -0.5}; }
  Sizes sizes() const { return {.nu = 7, .nz = 6, .constraints = 6}; }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    rigid::prismatic(u, g, 0, rigid::kGround, Vector3{0, 0, 0}, kFirstBody, Vector3{0.2, 0.1, 0.3}, along(),
                     Vector3{0, 1, 0}, Vector3{0.5, 0, 0.8660254037844386});
    g[5] = rigid::norm(u, 3);
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    rigid::writeInertia(r, p, kFirstBody, 3.0, kInertia);
    r.u[2] -= 3.0 * 9.81;
    rigid::addConstraintForces(*this, p, r);
  }
};

TEST(Rigid, ABodyOnARailFallsByHalfOfG) {
  const auto system = makeSystem<double>(OnARail{}, {.formulation = Formulation::kIndex2Projected});
  IntegratorOptions options;
  options.tolerances = {1e-9, 1e-9};
  State<double> start(system->sceneSizes());
  start.u << -0.2, -0.1, -0.3, 1, 0, 0, 0;
  Integrator<double> integrator(system, makeTableau<double>("radau_iia_3"), options);
  const auto end = integrator.integrate(start, 2);
  ASSERT_EQ(end.outcome, Outcome::kSuccess) << end.detail;
  const double way = 9.81 * 0.5 * 4 / 2;
  EXPECT_NEAR(end.state.u[0], -0.2 + way * OnARail::along().x, 1e-7);
  EXPECT_NEAR(end.state.u[1], -0.1, 1e-8);
  EXPECT_NEAR(end.state.u[2], -0.3 + way * OnARail::along().z, 1e-7);
  EXPECT_NEAR(end.state.u[3], 1, 1e-8);
}

}  // namespace
}  // namespace irk::test
