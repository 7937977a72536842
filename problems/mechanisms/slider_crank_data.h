// Data of the rigid slider-crank, and the equations of its tree of crank and rod. Internal to the crank scenes.
#pragma once

#include <cmath>
#include <vector>

#include "irk/scene_file.h"
#include "irk/vanishes.h"

namespace irk::slider_crank {

template <class Real>
struct Data {
  Real L1, L2;      // m
  Real m1, m2, m3;  // kg

  Real crankInertia() const { return m1 * L1 * L1 / 12; }
  Real rodInertia() const { return m2 * L2 * L2 / 12; }
};

/// The scene parameters for Data, with the same names as its members.
inline std::vector<Parameter> bodyParameters() {
  return {positiveParameter("L1", "m", "crank length", "0.1"),
          positiveParameter("L2", "m", "rod length, more than L1 for full turns", "0.3"),
          positiveParameter("m1", "kg", "mass of the crank", "0.2"),
          positiveParameter("m2", "kg", "mass of the rod", "0.2"),
          positiveParameter("m3", "kg", "mass of the slider", "0.4")};
}

template <class Real>
Data<Real> dataFrom(const Settings& settings) {
  const auto value = [&](const char* name) { return number<Real>(settings, name); };
  return {value("L1"), value("L2"), value("m1"), value("m2"), value("m3")};
}

/// Sines and cosines of crank and rod.
template <class T>
struct Angles {
  T sin_theta, cos_theta, sin_phi, cos_phi;
};

/// The rows f - M a for u = (theta, phi): the tree of crank and rod, with the mass of the slider at the end of the
/// rod and without applied forces.
template <class T>
struct TreeRows {
  T theta, phi;
};

template <class Real, class T>
TreeRows<T> treeRows(const Data<Real>& d, const Angles<T>& q, const T& theta_rate, const T& phi_rate,
                     const T& theta_acc, const T& phi_acc) {
  const Real half = d.m2 * d.L1 * d.L2 / 2;
  const T sin_diff = q.sin_theta * q.cos_phi - q.cos_theta * q.sin_phi;
  const T s1 = d.L1 * q.sin_theta, s2 = d.L2 * q.sin_phi;  // x3' = -s1 theta' - s2 phi'
  const T theta_rate2 = theta_rate * theta_rate, phi_rate2 = phi_rate * phi_rate;
  // x3'' = alpha - s1 theta'' - s2 phi''
  const T alpha = -(d.L1 * q.cos_theta) * theta_rate2 - (d.L2 * q.cos_phi) * phi_rate2;
  if (vanishes(theta_acc) && vanishes(phi_acc)) {  // M is not needed
    const T slider = d.m3 * alpha;
    return {s1 * slider - half * (sin_diff * phi_rate2), s2 * slider + half * (sin_diff * theta_rate2)};
  }
  const T cos_diff = q.cos_theta * q.cos_phi + q.sin_theta * q.sin_phi;
  const T slider = d.m3 * (alpha - s1 * theta_acc - s2 * phi_acc);
  const Real M11 = d.crankInertia() + d.L1 * d.L1 * (d.m1 / 4 + d.m2);
  const Real M22 = d.rodInertia() + d.L2 * d.L2 * d.m2 / 4;
  return {s1 * slider - half * (sin_diff * phi_rate2 + cos_diff * phi_acc) - M11 * theta_acc,
          s2 * slider + half * (sin_diff * theta_rate2 - cos_diff * theta_acc) - M22 * phi_acc};
}

}  // namespace irk::slider_crank
