// The rigid slider-crank's data and its three coordinate sets. Internal to slider_crank*.cpp.
#pragma once

#include <cmath>

#include "core/problem.h"

namespace irk::slider_crank {

template <class Real>
struct Data {
  Real L1, L2;         // m
  Real m1, m2, m3;     // kg
  Real torque;         // N m, on the crank
  Real torque_off_at;  // s

  Real J1() const { return m1 * L1 * L1 / 12; }
  Real J2() const { return m2 * L2 * L2 / 12; }
  template <class T>
  T torqueAt(const T& t) const {
    return t < torque_off_at ? T(torque) : T(0.0);
  }
};

/// Sines and cosines of crank and rod.
template <class T>
struct Angles {
  T sin_theta, cos_theta, sin_phi, cos_phi;
};

/// f - M a of the tree of crank and rod with the slider's mass at the rod's end: u = (theta, phi).
template <class T>
struct TreeRows {
  T theta, phi;
};

template <class Real, class T>
TreeRows<T> treeRows(const Data<Real>& d, const T& t, const Angles<T>& q, const T& theta_rate,
                     const T& phi_rate, const T& theta_acc, const T& phi_acc) {
  const Real half = d.m2 * d.L1 * d.L2 / 2;
  const T cos_diff = q.cos_theta * q.cos_phi + q.sin_theta * q.sin_phi;
  const T sin_diff = q.sin_theta * q.cos_phi - q.cos_theta * q.sin_phi;
  const T s1 = d.L1 * q.sin_theta, s2 = d.L2 * q.sin_phi;  // x3' = -s1 theta' - s2 phi'
  const T theta_rate2 = theta_rate * theta_rate, phi_rate2 = phi_rate * phi_rate;
  // x3'' = alpha - s1 theta'' - s2 phi''
  const T alpha = -(d.L1 * q.cos_theta) * theta_rate2 - (d.L2 * q.cos_phi) * phi_rate2;
  const T slider = d.m3 * (alpha - s1 * theta_acc - s2 * phi_acc);
  const Real M11 = d.J1() + d.L1 * d.L1 * (d.m1 / 4 + d.m2);
  const Real M22 = d.J2() + d.L2 * d.L2 * d.m2 / 4;
  return {d.torqueAt(t) + s1 * slider - half * (sin_diff * phi_rate2 + cos_diff * phi_acc) -
              M11 * theta_acc,
          s2 * slider + half * (sin_diff * theta_rate2 - cos_diff * theta_acc) - M22 * phi_acc};
}

/// u = (theta, phi), z = (lambda): 0 = L1 sin theta + L2 sin phi.
template <class Real>
struct Redundant {
  Data<Real> d;

  Sizes sizes() const { return {.nu = 2, .nx = 0, .nz = 1, .constraints = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    const Angles<T> q{sin(p.u[0]), cos(p.u[0]), sin(p.u[1]), cos(p.u[1])};
    const auto rows = treeRows<Real, T>(d, p.t, q, p.v[0], p.v[1], p.a[0], p.a[1]);
    r.u[0] = rows.theta - d.L1 * q.cos_theta * p.z[0];
    r.u[1] = rows.phi - d.L2 * q.cos_phi * p.z[0];
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    using std::sin;
    g[0] = d.L1 * sin(u[0]) + d.L2 * sin(u[1]);
  }
};

/// u = (theta); the rod follows: sin phi = -(L1 / L2) sin theta, cos phi > 0.
template <class Real>
struct Minimal {
  Data<Real> d;

  Sizes sizes() const { return {.nu = 1, .nx = 0, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    using std::sqrt;
    const T sin_theta = sin(p.u[0]), cos_theta = cos(p.u[0]);
    const Real ratio = d.L1 / d.L2;
    const T sin_phi = -ratio * sin_theta;
    const T cos_phi = sqrt(1 - sin_phi * sin_phi);
    // phi' = slope theta', and the constraint's second derivative for phi''.
    const T slope = -ratio * (cos_theta / cos_phi);
    const T phi_rate = slope * p.v[0];
    const T phi_acc = (ratio * (sin_theta * p.v[0] * p.v[0] - cos_theta * p.a[0]) +
                       sin_phi * phi_rate * phi_rate) /
                      cos_phi;
    const Angles<T> q{sin_theta, cos_theta, sin_phi, cos_phi};
    const auto rows = treeRows<Real, T>(d, p.t, q, p.v[0], phi_rate, p.a[0], phi_acc);
    r.u[0] = rows.theta + slope * rows.phi;
  }
};

/// Three bodies, u = (x1, y1, theta, x2, y2, phi, x3, y3): constant M, seven constraints. The
/// slider is a point mass.
template <class Real>
struct Absolute {
  Data<Real> d;

  Sizes sizes() const { return {.nu = 8, .nx = 0, .nz = 7, .constraints = 7}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    const auto& z = p.z;
    const T sin1 = d.L1 / 2 * sin(p.u[2]), cos1 = d.L1 / 2 * cos(p.u[2]);
    const T sin2 = d.L2 / 2 * sin(p.u[5]), cos2 = d.L2 / 2 * cos(p.u[5]);
    r.u[0] = -d.m1 * p.a[0] - z[0] - z[2];
    r.u[1] = -d.m1 * p.a[1] - z[1] - z[3];
    r.u[2] = d.torqueAt(p.t) - d.J1() * p.a[2] - sin1 * (z[0] - z[2]) + cos1 * (z[1] - z[3]);
    r.u[3] = -d.m2 * p.a[3] + z[2] - z[4];
    r.u[4] = -d.m2 * p.a[4] + z[3] - z[5];
    r.u[5] = -d.J2() * p.a[5] + sin2 * (z[2] + z[4]) - cos2 * (z[3] + z[5]);
    r.u[6] = -d.m3 * p.a[6] + z[4];
    r.u[7] = -d.m3 * p.a[7] + z[5] - z[6];
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    using std::cos;
    using std::sin;
    const auto sin1 = d.L1 / 2 * sin(u[2]), cos1 = d.L1 / 2 * cos(u[2]);
    const auto sin2 = d.L2 / 2 * sin(u[5]), cos2 = d.L2 / 2 * cos(u[5]);
    g[0] = u[0] - cos1;  // crank at the origin
    g[1] = u[1] - sin1;
    g[2] = u[0] + cos1 - u[3] + cos2;  // crank's tip is the rod's start
    g[3] = u[1] + sin1 - u[4] + sin2;
    g[4] = u[3] + cos2 - u[6];  // rod's end is the slider
    g[5] = u[4] + sin2 - u[7];
    g[6] = u[7];  // slider on its line
  }
};

}  // namespace irk::slider_crank
