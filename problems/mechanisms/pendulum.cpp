// The planar pendulum in Cartesian coordinates, released from the horizontal.
#include <cmath>

#include "irk/scene_file.h"
#include "irk/scene_lanes.h"
#include "problems/support/elliptic.h"

namespace irk {
namespace {

template <class Real>
struct Pendulum {
  Real m, l, g;  // kg, m, m/s^2

  Sizes sizes() const { return {.nu = 2, .nx = 0, .nz = 1, .constraints = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -m * p.a[0] - p.u[0] * p.z[0];
    r.u[1] = -m * p.a[1] - m * g - p.u[1] * p.z[0];
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& c) const {
    c[0] = (u[0] * u[0] + u[1] * u[1] - l * l) * 0.5;
  }

  static Pendulum with(const Settings& values) {
    return {number<Real>(values, "m"), number<Real>(values, "l"), number<Real>(values, "g")};
  }

  // theta is the angle from the lower equilibrium, with amplitude pi/2: sin(theta/2) = k cd(omega t), k^2 = 1/2,
  // cos(theta/2) = k' / dn, theta' = -2 k k' omega sn / dn, k k' = 1/2.
  State<Real> exact(const Real& t) const {
    using std::sqrt;
    const Real omega = sqrt(g / l);
    const Real k = sqrt(Real(0.5));
    const auto [sn, cn, dn, am] = jacobiFunctions<Real>(omega * t, Real(0.5));
    const Real half_sine = k * cn / dn, half_cosine = k / dn;
    const Real sine = 2 * half_sine * half_cosine;
    const Real cosine = 1 - 2 * half_sine * half_sine;
    const Real rate = -omega * sn / dn;
    State<Real> s(sizes());
    s.t = t;
    s.u << l * sine, -l * cosine;
    s.v << l * cosine * rate, l * sine * rate;
    const Real lambda = m * (rate * rate - g * s.u[1] / (l * l));
    s.w << -s.u[0] * lambda / m, -s.u[1] * lambda / m - g, lambda;
    return s;
  }
};

template <class Real>
Scene<Real> make(const Settings& settings) {
  const auto problem = Pendulum<Real>::with(settings);
  Scene<Real> scene;
  setProblem(scene, problem);
  scene.t_end = 10;
  const double m = static_cast<double>(problem.m), l = static_cast<double>(problem.l);
  const double g = static_cast<double>(problem.g);
  const double speed = std::sqrt(2 * g * l);
  setComponents(scene, {{"x", "m", l, speed}, {"y", "m", l, speed}}, {}, {{"lambda", "N/m", m * g / l}});
  scene.exact = [problem](const Real& t) { return problem.exact(t); };
  scene.start.u[0] = problem.l;  // exact(0) gives these values up to rounding only
  scene.start.w[1] = -problem.g;
  scene.outputs = {
      {"energy",
       [problem](const State<Real>& s) { return Real(problem.m * (s.v.squaredNorm() / 2 + problem.g * s.u[1])); }, "J",
       true}};
  return scene;
}

}  // namespace

SceneEntry pendulumEntry() {
  return {.id = "pendulum",
          .title = "pendulum in Cartesian coordinates, one multiplier",
          .shows = "index 3, index 2 and GGL against an exact solution, multiplier included",
          .collections = {"ivp", "multibody"},
          .literature = "HW II (VII.1)",
          .kind = SceneKind::kConstrained,
          .parameters = {positiveParameter("m", "kg", "mass", "1"), positiveParameter("l", "m", "length", "1"),
                         positiveParameter("g", "m/s^2", "gravity", "9.81")},
          .panels = {{"positions", {"x", "y"}}, {"velocities", {"x'", "y'"}}, {"multiplier", {"lambda"}}},
          .reference_cases = {{.times = "0.5 1 5", .tolerance = kManyDigits}},
          .make = make<double>,
          .make_mp50 = make<mp50>,
          .make_lanes = lanesOf<Pendulum>};
}

}  // namespace irk
