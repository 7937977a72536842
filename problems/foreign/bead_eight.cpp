// A bead on a wire that has the form of an eight, x^4 - x^2 + y^2 = 0, without force: its speed is constant, and it
// passes the crossing straight. The constraint has no gradient there.
#include "irk/scene_file.h"
#include "problems/support/gauss_rule.h"

using namespace irk;

namespace {

// With the parameter s of the wire, x = cos s and y = sin s cos s.
template <class Real>
struct Eight {
  Real v0;  // m/s

  Sizes sizes() const { return {.nu = 2, .nz = 1, .constraints = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {  // the mass is 1 kg
    r.u[0] = -(4 * p.u[0] * p.u[0] - 2) * p.u[0] * p.z[0] - p.a[0];
    r.u[1] = -2 * p.u[1] * p.z[0] - p.a[1];
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    g[0] = (u[0] * u[0] - 1) * u[0] * u[0] + u[1] * u[1];
  }
  static Eight with(const Settings& values) { return {number<Real>(values, "v0")}; }
  void start(State<Real>& s) const {
    s.u[0] = 1;
    s.v[1] = v0;
  }

  static Real speedOf(const Real& s) {  // the length of d(x, y)/ds
    using std::cos;
    using std::sin;
    using std::sqrt;
    const Real dx = -sin(s), dy = cos(Real(2 * s));
    return sqrt(Real(dx * dx + dy * dy));
  }
  // The s at the distance v0 t along the wire, by Newton's method. The length of a piece is found by Gauss' formula of
  // 30 nodes: the nearest singularity of the integrand is 0.6 away from the real axis, 12 half pieces, so that the
  // formula's error is about (12 + sqrt(145))^-60.
  Real parameterAt(const Real& t) const {
    using std::abs;
    using std::floor;
    const Real piece = Real(1) / 10, wanted = v0 * t;
    const GaussRule<Real> rule(30);
    const auto length = [&rule](const Real& from, const Real& to) { return rule(speedOf, from, to); };
    Real from = 0, covered = 0;
    for (Real next; covered + (next = length(from, Real(from + piece))) < wanted; from += piece) covered += next;
    Real s = from;
    for (int i = 0; i < 20; ++i) {
      const Real step =
          s > from ? Real((wanted - covered - length(from, s)) / speedOf(s)) : Real((wanted - covered) / speedOf(s));
      s += step;
      if (abs(step) < std::numeric_limits<Real>::epsilon()) break;
    }
    return s;
  }
  State<Real> exact(const Real& t) const {
    using std::cos;
    using std::sin;
    State<Real> state(sizes());
    state.t = t;
    const Real s = parameterAt(t), c = cos(s), dx = -sin(s), dy = cos(Real(2 * s)), ddy = -2 * sin(Real(2 * s));
    const Real speed = speedOf(s), rate = v0 / speed;                           // rate = ds/dt
    const Real change = -rate * rate * (dx * -c + dy * ddy) / (speed * speed);  // d2s/dt2
    state.u << c, sin(s) * c;
    state.v << dx * rate, dy * rate;
    const Real ax = -c * rate * rate + dx * change, ay = ddy * rate * rate + dy * change;
    const Real gx = (4 * c * c - 2) * c, gy = 2 * state.u[1];
    state.w << ax, ay, -(ax * gx + ay * gy) / (gx * gx + gy * gy);
    return state;
  }
  SceneFrame<Real> frame() const {
    return {.t_end = 1.2, .u = {{"x", "m", 1, 1}, {"y", "m", 1, 1}}, .z = {{"lambda", "N/m^3", 1}}};
  }
  static SceneEntry entry() {
    return {.id = "bead_eight",
            .title = "bead on a wire that has the form of an eight",
            .shows = "a singular position that is passed: another branch begins there",
            .collections = {"foreign"},
            .parameters = {numberParameter("v0", "m/s", "speed; the crossing is 1.52 m away", "1", 0.25, 4)},
            .reference_cases = {{}}};
  }
};

}  // namespace

IRK_SCENE(Eight)
