// A mass that falls on an elastic floor and bounces.
#include "irk/regularised.h"
#include "irk/scene_file.h"
#include "problems/support/piecewise_linear.h"

using namespace irk;

namespace {

// d = (1 in contact, 0 otherwise).
template <class Real>
struct BouncingMass {
  Real m, k, g;    // kg, N/m, m/s^2
  Real smoothing;  // m
  Real gap0, v0;   // m, m/s: at the start

  Sizes sizes() const { return {.nu = 1, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -m * g - k * (p.d[0] * p.u[0]) - m * p.a[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* due) const {
    due[0] = p.d[0] > T(0.0) ? T(p.u[0]) : T(-p.u[0]);
  }
  template <class T>
  void onSwitch(Index, const Point<T>& p, T* d) const {
    d[0] = 1 - p.d[0];
  }
  // The floor reaches its full stiffness over the first `smoothing` of the penetration. It never pulls.
  template <class T>
  void smoothed(const Point<T>& p, T* d) const {
    d[0] = smoothStep<T>(-p.u[0] / smoothing);
  }
  // The matrix of v' = rates (u, v, 1).
  Mat<Real> rates(const Vec<Real>& d) const {
    Mat<Real> rows(1, 3);
    rows << -k / m * d[0], 0, -g;
    return rows;
  }
  std::string switchName(Index) const { return "contact"; }
  static BouncingMass with(const Settings& values) {
    const auto value = [&](const char* name) { return number<Real>(values, name); };
    return {.m = value("m"),
            .k = value("k"),
            .g = value("g"),
            .smoothing = value("smoothing"),
            .gap0 = value("gap0"),
            .v0 = value("v0")};
  }
  void start(State<Real>& s) const {
    s.u[0] = gap0;
    s.v[0] = v0;
    s.d[0] = Real(gap0 < 0 ? 1 : 0);
  }
  State<Real> exact(const Real& t) const { return exactBetweenSwitches(*this, t); }
  SceneFrame<Real> frame() const { return {.t_end = 0.5, .u = {{"gap", "m", 0.01, 1}}}; }
  static SceneEntry entry() {
    return {.id = "bouncing_mass",
            .title = "mass bouncing on an elastic floor",
            .shows = "contact: a stiffness that acts only while the gap is closed",
            .collections = {"switching"},
            .parameters = {positiveParameter("m", "kg", "mass", "0.25"),
                           positiveParameter("k", "N/m", "stiffness of the floor", "2e4"),
                           numberParameter("g", "m/s^2", "gravity", "9.81", 0, 1e6),
                           numberParameter("gap0", "m", "gap at the start", "0.01", -1e6, 1e6),
                           numberParameter("v0", "m/s", "velocity at the start", "-1", -1e6, 1e6),
                           smoothingParameter("m", "penetration until the floor has its whole stiffness", "1e-5")},
            .panels = {{"gap", {"gap"}}, {"velocity", {"gap'"}}},
            .reference_cases = {{.times = "0.1 0.3"}}};
  }
};

}  // namespace

IRK_SCENE(BouncingMass)
