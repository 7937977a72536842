// Small problems with exact solutions for the tests of core; independent of problems/.
#pragma once

#include <cmath>
#include <vector>

#include "irk/problem.h"

namespace irk::test {

/// What a run begins with: each group whole, or not at all, and then it is 0.
struct Given {
  double t = 0;
  std::vector<double> u = {}, v = {}, x = {}, d = {};
};
inline State<double> startOf(const Sizes& sizes, const Given& given) {
  State<double> s(sizes);
  s.t = given.t;
  const auto fill = [](Vec<double>& to, const std::vector<double>& from) {
    if (!from.empty()) to = ConstVec<double>(from.data(), static_cast<Index>(from.size()));
  };
  fill(s.u, given.u);
  fill(s.v, given.v);
  fill(s.x, given.x);
  fill(s.d, given.d);
  return s;
}
template <class P>
State<double> startOf(const P& problem, const Given& given) {
  return startOf(problem.sizes(), given);
}

/// x' = rate(p) at the point p, one unknown: FirstOrder{[](const auto& p) { return -p.x[0]; }}.
template <class F>
struct FirstOrder {
  F rate;
  Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = rate(p) - p.k[0];
  }
};
template <class F>
FirstOrder(F) -> FirstOrder<F>;
/// u'' = rate(p) at the point p, one unknown.
template <class F>
struct SecondOrder {
  F rate;
  Sizes sizes() const { return {.nu = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = rate(p) - p.a[0];
  }
};
template <class F>
SecondOrder(F) -> SecondOrder<F>;

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

/// Base of a system of two coordinates on the unit circle.
struct OnUnitCircle {
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    g[0] = (u[0] * u[0] + u[1] * u[1] - 1.0) * 0.5;
  }
};

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

/// x' = -x from x = 1.
struct Decay {
  Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = -p.x[0] - p.k[0];
  }
};

/// Base of a system with one switch, which is due from the time `at` on: d[0] is 0 before it and 1 behind it.
struct SwitchesOnceAt {
  double at;
  explicit SwitchesOnceAt(double t) : at(t) {}
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    g[0] = p.d[0] > T(0.5) ? T(-1.0) : T(p.t - at);
  }
  template <class T>
  void onSwitch(Index, const Point<T>&, T* d) const {
    d[0] = T(1.0);
  }
};

/// x' = d, and d is 1 for t in (on, on + width), else 0. The function of switch 0 is a parabola, positive only then.
struct OnFor {
  double on, width;
  Sizes sizes() const { return {.nx = 1, .discrete = 1, .switches = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = p.d[0] - p.k[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* g) const {
    const bool is_on = p.d[0] > T(0.5);
    g[0] = is_on ? T(-1.0) : T((p.t - on) * (on + width - p.t));
    g[1] = is_on ? T(p.t - on - width) : T(-1.0);
  }
  template <class T>
  void onSwitch(Index i, const Point<T>&, T* d) const {
    d[0] = T(i == 0 ? 1.0 : 0.0);
  }
};

/// A ball that falls from height 1 with the acceleration g and keeps the part e of its speed at each impact on the
/// floor, which d counts.
struct BouncingBall {
  double g, e;
  Sizes sizes() const { return {.nu = 1, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -g - p.a[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* due) const {
    due[0] = p.v[0] < T(0.0) ? T(-p.u[0]) : T(-1.0);
  }
  template <class T>
  void onSwitch(Index, const Point<T>& p, T* d) const {
    d[0] = p.d[0] + 1.0;
  }
  template <class T>
  void jump(Index, const Point<T>& p, T*, T* v, T*) const {
    v[0] = -e * p.v[0];
  }
  State<double> start() const { return startOf(sizes(), {.u = {1}}); }
};

inline State<double> decayStart() { return startOf(Decay{}, {.x = {1}}); }
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
