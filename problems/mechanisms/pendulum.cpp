// The planar pendulum in Cartesian coordinates, released from the horizontal.
#include "irk/scene_file.h"
#include "problems/support/elliptic.h"

using namespace irk;

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
  void start(State<Real>& s) const { s.u[0] = l; }  // exact(0) has rounding errors
  SceneFrame<Real> frame() const {
    const double mass = static_cast<double>(m), length = static_cast<double>(l), gravity = static_cast<double>(g);
    const double speed = std::sqrt(2 * gravity * length);
    const auto energy = [*this](const State<Real>& s) { return Real(m * (s.v.squaredNorm() / 2 + g * s.u[1])); };
    return {.t_end = 10,
            .u = {{"x", "m", length, speed}, {"y", "m", length, speed}},
            .z = {{"lambda", "N/m", mass * gravity / length}},
            .outputs = {{"energy", energy, "J", true}}};
  }
  static SceneEntry entry() {
    return {.id = "pendulum",
            .title = "pendulum in Cartesian coordinates, one multiplier",
            .shows = "index 3, index 2 and GGL against an exact solution, multiplier included",
            .collections = {"ivp", "multibody"},
            .literature = "HW II (VII.1)",
            .parameters = {positiveParameter("m", "kg", "mass", "1"), positiveParameter("l", "m", "length", "1"),
                           positiveParameter("g", "m/s^2", "gravity", "9.81")},
            .panels = {{"positions", {"x", "y"}}, {"velocities", {"x'", "y'"}}, {"multiplier", {"lambda"}}},
            .reference_cases = {{.times = "0.5 1 5", .tolerance = kManyDigits}}};
  }
};

}  // namespace

IRK_SCENE(Pendulum)
