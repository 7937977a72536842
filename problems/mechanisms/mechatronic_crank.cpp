// A slider-crank with a DC motor, a chopper, a speed controller and Coulomb friction on the slider.
//
// u = (theta, phi), z = (lambda) as in the redundant form of slider_crank; x = (i, e), the current of the motor and
// the integral of the speed error.
#include "irk/scene_file.h"
#include "problems/mechanisms/slider_crank_data.h"

using namespace irk;

namespace {

using slider_crank::Angles;
using slider_crank::Data;
using slider_crank::treeRows;

// d = (1 while the supply is on, 0 otherwise; sign of the slider's velocity). There is no regularisation: with
// the hysteresis of the chopper the mode depends on the past.
enum Discrete : Index { kSupply, kDirection };
enum Switch : Index { kChopper, kSliderTurns };

std::vector<Parameter> parameters() {
  std::vector<Parameter> all = slider_crank::bodyParameters();
  all.insert(all.end(), {positiveParameter("U", "V", "supply voltage", "12"),
                         numberParameter("R", "Ohm", "resistance of the armature", "1", 0, 1e15),
                         positiveParameter("L", "H", "inductance of the armature", "0.1"),
                         positiveParameter("kM", "N m/A", "motor constant", "0.1"),
                         numberParameter("Fc", "N", "Coulomb friction of the slider", "1", 0, 1e15),
                         numberParameter("wref", "rad/s", "wanted speed of the crank", "10", -1e6, 1e6),
                         numberParameter("Kp", "A s", "proportional gain", "0.5", -1e15, 1e15),
                         numberParameter("Ki", "A", "integral gain", "2", -1e15, 1e15),
                         positiveParameter("D", "A", "half width of the current's band", "1")});
  return all;
}

template <class Real>
struct MechatronicCrank {
  Data<Real> crank;
  Real U, R, L, kM;      // V, Ohm, H, N m/A
  Real Fc;               // N
  Real wref, Kp, Ki, D;  // rad/s, A s, A, A

  Sizes sizes() const { return {.nu = 2, .nx = 2, .nz = 1, .constraints = 1, .discrete = 2, .switches = 2}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    const Angles<T> q{sin(p.u[0]), cos(p.u[0]), sin(p.u[1]), cos(p.u[1])};
    const auto rows = treeRows<Real, T>(crank, q, p.v[0], p.v[1], p.a[0], p.a[1]);
    const T& current = p.x[0];
    const T friction = Fc * p.d[kDirection];  // opposes x3' = -L1 sin theta theta' - L2 sin phi phi'
    r.u[0] = kM * current + friction * (crank.L1 * q.sin_theta) + rows.theta - crank.L1 * q.cos_theta * p.z[0];
    r.u[1] = friction * (crank.L2 * q.sin_phi) + rows.phi - crank.L2 * q.cos_phi * p.z[0];
    r.x[0] = U * p.d[kSupply] - R * current - kM * p.v[0] - L * p.k[0];
    r.x[1] = wref - p.v[0] - p.k[1];
  }
  template <class T, class Angle, class G>
  void constraints(const T&, const Angle& u, G&& g) const {
    using std::sin;
    g[0] = crank.L1 * sin(u[0]) + crank.L2 * sin(u[1]);
  }
  template <class T>
  void switching(const Point<T>& p, T* due) const {
    using std::sin;
    const T above = p.x[0] - Kp * (wref - p.v[0]) - Ki * p.x[1];
    due[kChopper] = p.d[kSupply] > T(0.0) ? T(above - D) : T(-D - above);
    const T x3_rate = -crank.L1 * sin(p.u[0]) * p.v[0] - crank.L2 * sin(p.u[1]) * p.v[1];
    due[kSliderTurns] = -p.d[kDirection] * x3_rate;
  }
  template <class T>
  void onSwitch(Index i, const Point<T>& p, T* d) const {
    if (i == kChopper) {
      d[kSupply] = 1 - p.d[kSupply];
    } else {
      d[kDirection] = -p.d[kDirection];
    }
  }
  std::string switchName(Index i) const { return i == kChopper ? "chopper" : "slider turns"; }
  static MechatronicCrank with(const Settings& values) {
    const auto value = [&](const char* name) { return number<Real>(values, name); };
    return {.crank = slider_crank::dataFrom<Real>(values),
            .U = value("U"),
            .R = value("R"),
            .L = value("L"),
            .kM = value("kM"),
            .Fc = value("Fc"),
            .wref = value("wref"),
            .Kp = value("Kp"),
            .Ki = value("Ki"),
            .D = value("D")};
  }
  void start(State<Real>& s) const { s.d << 1, -1; }
  SceneFrame<Real> frame() const {
    const auto slider = [crank = crank](const State<Real>& s) {
      using std::cos;
      return Real(crank.L1 * cos(s.u[0]) + crank.L2 * cos(s.u[1]));
    };
    return {.t_end = 1,
            .u = {{"theta", "rad", 1, 10}, {"phi", "rad", 1, 10}},
            .x = {{"i", "A", 5}, {"e", "rad"}},
            .z = {{"lambda", "N"}},
            .outputs = {{"x3", slider, "m"}}};
  }
  static SceneEntry entry() {
    return {.id = "mechatronic_crank",
            .title = "slider-crank with motor, chopper, speed controller and friction",
            .shows = "a whole mechatronic system: u, x, z and two kinds of switches",
            .collections = {"multibody", "switching"},
            .parameters = parameters(),
            .panels = {{"angles", {"theta", "phi"}},
                       {"angular velocities", {"theta'", "phi'"}},
                       {"current", {"i"}},
                       {"controller state", {"e"}},
                       {"slider", {"x3"}},
                       {"multiplier", {"lambda"}}},
            .reference_cases = {{.times = "0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8 0.9"}}};
  }
};

}  // namespace

IRK_SCENE(MechatronicCrank)
