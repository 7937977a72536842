// The rigid slider-crank in three coordinate sets. Internal to slider_crank.cpp.
#pragma once

#include <cmath>

#include "irk/regularised.h"
#include "problems/mechanisms/slider_crank_data.h"

namespace irk::slider_crank {

/// The torque on the crank and its switches, for all three sets of coordinates: it alternates between two levels, and
/// it may be switched off for good. d = (1 while the torque is on, 0 otherwise; 1 at the first level, 0 at the second;
/// the number of the next change of level); of a torque without switches, d is empty.
template <class Real>
struct SwitchedTorque {
  static constexpr Index kOn = 0, kFirstLevel = 1, kNext = 2;  // of d
  static constexpr Index kOff = 0, kLevel = 1;                 // switches

  Real first, second;              // N m
  bool ever_off, ever_alternates;  // whether it is ever switched off, whether the level ever changes
  Real off_at, every;              // s
  Real smoothing;                  // s

  Sizes withSwitches(Sizes sizes) const {
    sizes.discrete = switched() ? 3 : 0;
    sizes.switches = switched() ? 2 : 0;
    return sizes;
  }
  bool switched() const { return ever_off || ever_alternates; }
  template <class T>
  T torqueAt(const Point<T>& p) const {
    return switched() ? T(p.d[kOn] * (second + (first - second) * p.d[kFirstLevel])) : T(first);
  }
  template <class T>
  void switching(const Point<T>& p, T* due) const {
    due[kOff] = ever_off && p.d[kOn] > T(0.0) ? T(p.t - off_at) : T(-1.0);
    due[kLevel] = ever_alternates ? T(p.t - p.d[kNext] * every) : T(-1.0);
  }
  template <class T>
  void onSwitch(Index i, const Point<T>& p, T* d) const {
    if (i == kOff) {
      d[kOn] = T(0.0);
      return;
    }
    // A step may be longer than the time between two changes.
    do {
      d[kFirstLevel] = 1 - d[kFirstLevel];
      d[kNext] = d[kNext] + 1;
    } while (p.t >= d[kNext] * every);
  }
  template <class T>
  void smoothed(const Point<T>& p, T* d) const {
    d[kOn] = ever_off ? smoothStep<T>(((off_at - p.t) / smoothing + 1) / 2) : T(1.0);
    if (!ever_alternates) return;
    Real next = every;  // the change of level that is nearest to t
    bool first_before = true;
    for (; T(next + every / 2) < p.t; next += every) first_before = !first_before;
    const T before = smoothStep<T>(((next - p.t) / smoothing + 1) / 2);
    d[kFirstLevel] = first_before ? before : T(1 - before);
  }
  std::string switchName(Index i) const { return i == kOff ? "torque off" : "torque level"; }
};

/// Two angles with one constraint, u = (theta, phi), z = (lambda): 0 = L1 sin theta + L2 sin phi.
template <class Real>
struct Redundant : SwitchedTorque<Real> {
  Data<Real> d;

  Sizes sizes() const { return this->withSwitches({.nu = 2, .nz = 1, .constraints = 1}); }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    const Angles<T> q{sin(p.u[0]), cos(p.u[0]), sin(p.u[1]), cos(p.u[1])};
    const auto rows = treeRows<Real, T>(d, q, p.v[0], p.v[1], p.a[0], p.a[1]);
    r.u[0] = this->torqueAt(p) + rows.theta - d.L1 * q.cos_theta * p.z[0];
    r.u[1] = rows.phi - d.L2 * q.cos_phi * p.z[0];
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    using std::sin;
    g[0] = d.L1 * sin(u[0]) + d.L2 * sin(u[1]);
  }
};

/// One angle without constraints, u = (theta). The rod follows: sin phi = -(L1 / L2) sin theta, cos phi > 0.
template <class Real>
struct Minimal : SwitchedTorque<Real> {
  Data<Real> d;

  Sizes sizes() const { return this->withSwitches({.nu = 1}); }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    using std::sqrt;
    const T sin_theta = sin(p.u[0]), cos_theta = cos(p.u[0]);
    const Real ratio = d.L1 / d.L2;
    const T sin_phi = -ratio * sin_theta;
    const T cos_phi = sqrt(1 - sin_phi * sin_phi);
    // phi' = slope theta'; phi'' follows from the second derivative of the constraint.
    const T slope = -ratio * (cos_theta / cos_phi);
    const T phi_rate = slope * p.v[0];
    const T phi_acc =
        (ratio * (sin_theta * p.v[0] * p.v[0] - cos_theta * p.a[0]) + sin_phi * phi_rate * phi_rate) / cos_phi;
    const Angles<T> q{sin_theta, cos_theta, sin_phi, cos_phi};
    const auto rows = treeRows<Real, T>(d, q, p.v[0], phi_rate, p.a[0], phi_acc);
    r.u[0] = this->torqueAt(p) + rows.theta + slope * rows.phi;
  }
};

/// Three bodies, u = (x1, y1, theta, x2, y2, phi, x3, y3), with a constant M and seven constraints. The
/// slider is a point mass.
template <class Real>
struct Absolute : SwitchedTorque<Real> {
  Data<Real> d;

  Sizes sizes() const { return this->withSwitches({.nu = 8, .nz = 7, .constraints = 7}); }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    const auto& z = p.z;
    const T sin1 = d.L1 / 2 * sin(p.u[2]), cos1 = d.L1 / 2 * cos(p.u[2]);
    const T sin2 = d.L2 / 2 * sin(p.u[5]), cos2 = d.L2 / 2 * cos(p.u[5]);
    r.u[0] = -d.m1 * p.a[0] - z[0] - z[2];
    r.u[1] = -d.m1 * p.a[1] - z[1] - z[3];
    r.u[2] = this->torqueAt(p) - d.crankInertia() * p.a[2] - sin1 * (z[0] - z[2]) + cos1 * (z[1] - z[3]);
    r.u[3] = -d.m2 * p.a[3] + z[2] - z[4];
    r.u[4] = -d.m2 * p.a[4] + z[3] - z[5];
    r.u[5] = -d.rodInertia() * p.a[5] + sin2 * (z[2] + z[4]) - cos2 * (z[3] + z[5]);
    r.u[6] = -d.m3 * p.a[6] + z[4];
    r.u[7] = -d.m3 * p.a[7] + z[5] - z[6];
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    using std::cos;
    using std::sin;
    const auto sin1 = d.L1 / 2 * sin(u[2]), cos1 = d.L1 / 2 * cos(u[2]);
    const auto sin2 = d.L2 / 2 * sin(u[5]), cos2 = d.L2 / 2 * cos(u[5]);
    g[0] = u[0] - cos1;  // the crank turns about the origin
    g[1] = u[1] - sin1;
    g[2] = u[0] + cos1 - u[3] + cos2;  // the tip of the crank is the start of the rod
    g[3] = u[1] + sin1 - u[4] + sin2;
    g[4] = u[3] + cos2 - u[6];  // the end of the rod is the slider
    g[5] = u[4] + sin2 - u[7];
    g[6] = u[7];  // the slider stays on its line
  }
};

}  // namespace irk::slider_crank
