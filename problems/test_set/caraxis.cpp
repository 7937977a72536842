// The axis of a car on a bumpy road (Schneider). IVP test set, CARAXIS.
#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct CarAxis {
  Real mass = decimal<Real>("5e-4");  // eps^2 M / 2
  Real bump = decimal<Real>("0.1");
  double l0 = 0.5;

  Sizes sizes() const { return {.nu = 4, .nz = 2, .constraints = 2}; }
  template <class T>
  T yb(const T& t) const {
    using std::sin;
    return bump * sin(10 * t);
  }
  template <class T>
  T xb(const T& t) const {
    using std::sqrt;
    return sqrt(1 - yb(t) * yb(t));
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::sqrt;
    const T &xl = p.u[0], &yl = p.u[1], &xr = p.u[2], &yr = p.u[3], &lambda1 = p.z[0], &lambda2 = p.z[1];
    const T x = xb(p.t), y = yb(p.t), dx = xr - x, dy = yr - y;
    const T left = l0 / sqrt(xl * xl + yl * yl) - 1, right = l0 / sqrt(dx * dx + dy * dy) - 1;
    const T across = 2 * lambda2 * (xl - xr), along = 2 * lambda2 * (yl - yr);
    r.u[0] = left * xl + lambda1 * x + across - mass * p.a[0];
    r.u[1] = left * yl + lambda1 * y + along - mass - mass * p.a[1];
    r.u[2] = right * dx - across - mass * p.a[2];
    r.u[3] = right * dy - along - mass - mass * p.a[3];
  }
  // The constraints are -phi of the test set, where the multipliers have the opposite sign.
  template <class T, class U, class G>
  void constraints(const T& t, const U& u, G&& c) const {
    const auto dx = u[0] - u[2], dy = u[1] - u[3];
    c[0] = -(u[0] * xb(t) + u[1] * yb(t));
    c[1] = 1 - (dx * dx + dy * dy);
  }
  void start(State<Real>& s) const {
    s.u << Real(0), Real(0.5), Real(1), Real(0.5);
    s.v << Real(-0.5), Real(0), Real(-0.5), Real(0);
  }
  SceneFrame<Real> frame() const {
    return {.t_end = 3, .u = named("m", {"xl", "yl", "xr", "yr"}), .z = {{"lambda1"}, {"lambda2"}}};
  }
  static SceneEntry entry() {
    return {.id = "caraxis",
            .title = "axis of a car on a bumpy road",
            .shows = "constraints that depend on time, a small mass between stiff springs",
            .collections = {"ivp", "multibody"},
            .literature = "IVP test set, CARAXIS",
            .panels = {{"heights of the ends", {"yl", "yr"}}},
            .reference_cases = {{.tolerance = kFewDigits}}};
  }
};

}  // namespace

IRK_SCENE(CarAxis)
