// Small problems with exact solutions for the tests of core; independent of problems/.
#pragma once

#include <cmath>

#include "irk/problem.h"

namespace irk::test {

/// y' = -(y^2 - phi^2) + phi', phi = 1.5 + sin t, with the solution y = phi. Nonlinear and non-autonomous, so every
/// damaged tableau loses order.
struct Riccati {
  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    const T phi = 1.5 + sin(p.t);
    r.x[0] = phi * phi - p.x[0] * p.x[0] + cos(p.t) - p.k[0];
  }
};

/// A pendulum of length l in Cartesian coordinates, g = 9.81, with one multiplier.
template <class Real>
struct LongPendulum {
  Real l{1};
  Sizes sizes() const { return {.nu = 2, .nx = 0, .nz = 1, .constraints = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -p.a[0] - p.u[0] * p.z[0];
    r.u[1] = -p.a[1] - 9.81 - p.u[1] * p.z[0];
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    g[0] = (u[0] * u[0] + u[1] * u[1] - l * l) * 0.5;
  }
  static void start(State<double>& s, double l) { s.u << l, 0; }
};
/// Of length 1.
using CartesianPendulum = LongPendulum<double>;

/// Two coupled nonlinear oscillators with a mass matrix that depends on u: a second-order ODE.
struct Oscillators {
  Sizes sizes() const { return {.nu = 2, .nx = 0, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    const T c = cos(p.u[0] - p.u[1]), s = sin(p.u[0] - p.u[1]);
    r.u[0] = -2.0 * p.a[0] - c * p.a[1] - s * p.v[1] * p.v[1] - 19.62 * sin(p.u[0]);
    r.u[1] = -c * p.a[0] - p.a[1] + s * p.v[0] * p.v[0] - 9.81 * sin(p.u[1]);
  }
};

template <class Real>
State<Real> pendulumStart() {
  State<Real> s(CartesianPendulum{}.sizes());
  s.u[0] = Real(1);
  return s;
}
template <class Real>
State<Real> riccatiStart() {
  State<Real> s(Riccati{}.sizes());
  s.x[0] = Real(1.5);
  return s;
}
template <class Real>
State<Real> oscillatorsStart() {
  State<Real> s(Oscillators{}.sizes());
  s.u << Real(1.2), Real(0.4);
  return s;
}

}  // namespace irk::test
