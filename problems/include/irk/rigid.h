// Rigid bodies in space as functions for a residual: rotation by quaternions, inertia, and joints with their forces.
//
// A body has seven of the positions u from `first` on: the centre of mass x in space, and the unit quaternion e (Euler
// parameters) that turns the body's axes into those of space. Its angular velocity in the body's axes is
//   Omega = 2 G(e) e',   e' = e o (0, Omega) / 2,   (0, G(e) v) the product of conj(e) and v.
// Lagrange's equations of the kinetic energy m |x'|^2 / 2 + 2 e'^T G^T J G e' are (P. Nikravesh, Computer-Aided
// Analysis of Mechanical Systems, 1988, section 11.2)
//   m x'' = F,   4 G^T J G e'' + 8 G'^T J G e' = Q + lambda e,   0 = (e^T e - 1) / 2.
// The mass matrix is singular along e; with the constraint of the norm the motion is determined. Joints are rows of
// g(t, u): they write to g from number `at` on, and addConstraintForces makes their forces. The scene
// experiments/examples/swinging_gate.cpp is made of these functions.
#pragma once

#include <algorithm>
#include <array>
#include <type_traits>

#include "irk/problem_system.h"

namespace irk::rigid {

template <class T>
struct Vector {
  T x, y, z;
};
template <class T>
Vector<T> operator-(const Vector<T>& a, const Vector<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
T dot(const Vector<T>& a, const Vector<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// G(e) v, the vector part of conj(e) o v: half the angular velocity for v = e'. E and V are vectors, e and v their
/// entries from i on.
template <class T, class E, class V>
Vector<T> bodyRate(const E& e, const V& v, Index i) {
  return {e[i] * v[i + 1] - e[i + 1] * v[i] - e[i + 2] * v[i + 3] + e[i + 3] * v[i + 2],
          e[i] * v[i + 2] - e[i + 2] * v[i] - e[i + 3] * v[i + 1] + e[i + 1] * v[i + 3],
          e[i] * v[i + 3] - e[i + 3] * v[i] - e[i + 1] * v[i + 2] + e[i + 2] * v[i + 1]};
}

/// e o (0, w) = G^T w.
template <class T, class E>
std::array<T, 4> product(const E& e, Index i, const Vector<T>& w) {
  return {-e[i + 1] * w.x - e[i + 2] * w.y - e[i + 3] * w.z, e[i] * w.x + e[i + 2] * w.z - e[i + 3] * w.y,
          e[i] * w.y + e[i + 3] * w.x - e[i + 1] * w.z, e[i] * w.z + e[i + 1] * w.y - e[i + 2] * w.x};
}

/// The body's vector r in space, times |e|^2: homogeneous of degree 2 in e.
template <class E, class R>
auto turned(const E& e, Index i, const Vector<R>& r) {
  const auto &e0 = e[i], &e1 = e[i + 1], &e2 = e[i + 2], &e3 = e[i + 3];
  using T = std::decay_t<decltype(e0)>;
  const T d = e0 * e0 - e1 * e1 - e2 * e2 - e3 * e3, along = 2 * (e1 * r.x + e2 * r.y + e3 * r.z);
  return Vector<T>{d * r.x + along * e1 + 2 * e0 * (e2 * r.z - e3 * r.y),
                   d * r.y + along * e2 + 2 * e0 * (e3 * r.x - e1 * r.z),
                   d * r.z + along * e3 + 2 * e0 * (e1 * r.y - e2 * r.x)};
}

/// Adds to rows[0..3] the derivative of f . turned(e, i, r) with respect to e: the generalized force of f at r.
template <class T, class E, class R>
void addTurnedForce(T* rows, const E& e, Index i, const Vector<R>& r, const Vector<T>& f) {
  const T &e0 = e[i], &e1 = e[i + 1], &e2 = e[i + 2], &e3 = e[i + 3];
  const T turn_x = r.y * f.z - r.z * f.y, turn_y = r.z * f.x - r.x * f.z, turn_z = r.x * f.y - r.y * f.x;
  const T xx = r.x * f.x, yy = r.y * f.y, zz = r.z * f.z;
  const T xy = r.x * f.y + r.y * f.x, xz = r.x * f.z + r.z * f.x, yz = r.y * f.z + r.z * f.y;
  rows[0] += 2 * (e0 * (xx + yy + zz) + e1 * turn_x + e2 * turn_y + e3 * turn_z);
  rows[1] += 2 * (e1 * (xx - yy - zz) + e0 * turn_x + e2 * xy + e3 * xz);
  rows[2] += 2 * (e2 * (yy - xx - zz) + e0 * turn_y + e1 * xy + e3 * yz);
  rows[3] += 2 * (e3 * (zz - xx - yy) + e0 * turn_z + e1 * xz + e2 * yz);
}

/// Subtracts from rows[0..3] the inertia 4 G^T J G e'' + 8 G'^T J G e' of the quaternion from i on. J: the principal
/// moments of inertia about the body's axes.
template <class T, class Real>
void subtractTurningInertia(T* rows, const Point<T>& p, Index i, const Vector<Real>& J) {
  const Vector<T> w = bodyRate<T>(p.u, p.v, i), rate = bodyRate<T>(p.u, p.a, i);
  const auto accelerated = product<T>(p.u, i, {J.x * rate.x, J.y * rate.y, J.z * rate.z});
  const auto turning = product<T>(p.v, i, {J.x * w.x, J.y * w.y, J.z * w.z});
  for (std::size_t k = 0; k < 4; ++k) rows[k] -= 4 * accelerated[k] + 8 * turning[k];
}

/// The constraint of the norm of the quaternion from i on.
template <class U>
auto norm(const U& u, Index i) {
  return (u[i] * u[i] + u[i + 1] * u[i + 1] + u[i + 2] * u[i + 2] + u[i + 3] * u[i + 3] - 1) * 0.5;
}

/// A body by the number of its first position, or the ground, whose axes are those of space.
struct Body {
  Index first;
};
inline constexpr Body kGround{-1};

/// The body's vector r in space.
template <class U, class Real>
auto direction(const U& u, Body body, const Vector<Real>& r) {
  using T = std::decay_t<decltype(u[0])>;
  return body.first < 0 ? Vector<T>{T(r.x), T(r.y), T(r.z)} : turned(u, body.first + 3, r);
}
/// The body's point r, relative to its centre of mass, in space.
template <class U, class Real>
auto point(const U& u, Body body, const Vector<Real>& r) {
  auto at = direction(u, body, r);
  if (body.first >= 0) at.x += u[body.first], at.y += u[body.first + 1], at.z += u[body.first + 2];
  return at;
}

/// Writes the inertia of a body of mass m to its rows of r.
template <class T, class Real>
void writeInertia(Rows<T> r, const Point<T>& p, Body body, const Real& m, const Vector<Real>& J) {
  for (Index k = 0; k < 7; ++k) r.u[body.first + k] = k < 3 ? T(-m * p.a[body.first + k]) : T(0.0);
  subtractTurningInertia(&r.u[body.first + 3], p, body.first + 3, J);
}
/// Adds the force f, in space, at the body's point `at`.
template <class T, class Real>
void addForce(Rows<T> r, const Point<T>& p, Body body, const Vector<Real>& at, const Vector<T>& f) {
  r.u[body.first] += f.x, r.u[body.first + 1] += f.y, r.u[body.first + 2] += f.z;
  addTurnedForce(&r.u[body.first + 3], p.u, body.first + 3, at, f);
}
/// Adds G^T z, the forces of all position constraints of a problem, to its rows of u: the gradients by dual numbers.
template <class P, class T>
void addConstraintForces(const P& problem, const Point<T>& p, Rows<T> r) {
  const auto chunk = static_cast<Index>(kChunk);
  for (Index first = 0; first < p.u.size(); first += chunk) {
    const Index count = std::min(chunk, p.u.size() - first);
    problem.constraints(Dual<T>(p.t), detail::DirectionView<T>{p.u, first},
                        detail::TransposedSink<T>{r.u.data() + first, count, p.z});
  }
}

/// Point s of body b is point r of body a: three rows. Its multipliers are the force on b, in space.
template <class U, class G, class V>
void spherical(const U& u, G&& g, Index at, Body a, const V& r, Body b, const V& s) {
  const auto d = point(u, b, s) - point(u, a, r);
  g[at] = d.x;
  g[at + 1] = d.y;
  g[at + 2] = d.z;
}
/// The same, and b turns about the axis n of a only: five rows. m1 and m2: two directions of b across n.
template <class U, class G, class V>
void revolute(const U& u, G&& g, Index at, Body a, const V& r, Body b, const V& s, const V& n, const V& m1,
              const V& m2) {
  spherical(u, g, at, a, r, b, s);
  g[at + 3] = dot(direction(u, a, n), direction(u, b, m1));
  g[at + 4] = dot(direction(u, a, n), direction(u, b, m2));
}
/// Point s of b slides along n of a through its point r, and b does not turn against a: five rows. n, m1 and m2 are
/// directions of both bodies, across each other.
template <class U, class G, class V>
void prismatic(const U& u, G&& g, Index at, Body a, const V& r, Body b, const V& s, const V& n, const V& m1,
               const V& m2) {
  const auto d = point(u, b, s) - point(u, a, r);
  g[at] = dot(direction(u, a, m1), d);
  g[at + 1] = dot(direction(u, a, m2), d);
  g[at + 2] = dot(direction(u, a, n), direction(u, b, m1));
  g[at + 3] = dot(direction(u, a, n), direction(u, b, m2));
  g[at + 4] = dot(direction(u, a, m1), direction(u, b, m2));
}

}  // namespace irk::rigid
