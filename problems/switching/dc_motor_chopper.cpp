// A DC motor whose current is held in a band by a chopper with hysteresis.
//
// u = phi, angle of the rotor; x = i, current.
#include "irk/scene_file.h"
#include "problems/support/piecewise_linear.h"

using namespace irk;

namespace {

// d = (1 while the supply is on, 0 otherwise). There is no regularisation: with hysteresis the mode depends
// on the past.
template <class Real>
struct DcMotorChopper {
  Real U, R, L;       // V, Ohm, H
  Real kM, J, b, TL;  // N m/A, kg m^2, N m s, N m
  Real iref, D;       // A, A

  Sizes sizes() const { return {.nu = 1, .nx = 1, .discrete = 1, .switches = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T& current = p.x[0];
    r.u[0] = kM * current - b * p.v[0] - TL - J * p.a[0];
    r.x[0] = U * p.d[0] - R * current - kM * p.v[0] - L * p.k[0];
  }
  template <class T>
  void switching(const Point<T>& p, T* due) const {
    const T above = p.x[0] - iref;
    due[0] = p.d[0] > T(0.0) ? T(above - D) : T(-D - above);
  }
  template <class T>
  void onSwitch(Index, const Point<T>& p, T* d) const {
    d[0] = 1 - p.d[0];
  }
  // The matrix of (v', x') = rates (u, v, x, 1).
  Mat<Real> rates(const Vec<Real>& d) const {
    Mat<Real> rows(2, 4);
    rows << 0, -b / J, kM / J, -TL / J,  //
        0, -kM / L, -R / L, U / L * d[0];
    return rows;
  }
  std::string switchName(Index) const { return "chopper"; }
  static DcMotorChopper with(const Settings& values) {
    const auto value = [&](const char* name) { return number<Real>(values, name); };
    return {.U = value("U"),
            .R = value("R"),
            .L = value("L"),
            .kM = value("kM"),
            .J = value("J"),
            .b = value("b"),
            .TL = value("TL"),
            .iref = value("iref"),
            .D = value("D")};
  }
  void start(State<Real>& s) const { s.d[0] = 1; }
  State<Real> exact(const Real& t) const { return exactBetweenSwitches(*this, t); }
  SceneFrame<Real> frame() const { return {.t_end = 0.02, .u = {{"phi", "rad", 0.1, 10}}, .x = {{"i", "A", 5}}}; }
  static SceneEntry entry() {
    return {.id = "dc_motor_chopper",
            .title = "DC motor behind a two-level chopper with hysteresis",
            .shows = "power electronics: the current switches the supply when it leaves a band",
            .collections = {"switching"},
            .parameters = {positiveParameter("U", "V", "supply voltage", "24"),
                           numberParameter("R", "Ohm", "resistance of the armature", "1", 0, 1e15),
                           positiveParameter("L", "H", "inductance of the armature", "0.01"),
                           positiveParameter("kM", "N m/A", "motor constant", "0.05"),
                           positiveParameter("J", "kg m^2", "inertia of the rotor", "2e-4"),
                           numberParameter("b", "N m s", "viscous friction", "1e-4", 0, 1e15),
                           numberParameter("TL", "N m", "load torque", "0.05", -1e15, 1e15),
                           numberParameter("iref", "A", "wanted current", "4", -1e15, 1e15),
                           positiveParameter("D", "A", "half width of the current's band", "1")},
            .panels = {{"angle", {"phi"}}, {"angular velocity", {"phi'"}}, {"current", {"i"}}},
            .reference_cases = {{.times = "0.005 0.01"}}};
  }
};

}  // namespace

IRK_SCENE(DcMotorChopper)
