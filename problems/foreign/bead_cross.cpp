// A bead on two wires that cross, x y = 0. It slides along x towards the crossing, where the constraint has no
// gradient; a force pulls it along the other wire.
#include <limits>

#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct CrossingWires {
  Real force, v0;                  // N, m/s
  Real x0 = decimal<Real>("0.7");  // m

  Sizes sizes() const { return {.nu = 2, .nz = 1, .constraints = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {  // the mass is 1 kg
    r.u[0] = -p.u[1] * p.z[0] - p.a[0];
    r.u[1] = force - p.u[0] * p.z[0] - p.a[1];
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    g[0] = u[0] * u[1];
  }
  static CrossingWires with(const Settings& values) {
    return {number<Real>(values, "force"), number<Real>(values, "v0")};
  }
  // The speed stays v0. The multiplier is infinite in the crossing, beyond which nothing determines the wire.
  State<Real> exact(const Real& t) const {
    State<Real> s(sizes());
    s.t = t;
    const Real x = x0 - v0 * t;
    s.u << x, Real(0);
    s.v << -v0, Real(0);
    s.w << Real(0), Real(0), force / x;
    if (x <= 0) {
      for (auto* part : {&s.u, &s.v, &s.w}) part->setConstant(std::numeric_limits<Real>::infinity());
    }
    return s;
  }
  SceneFrame<Real> frame() const {
    return {.t_end = 0.6, .u = {{"x", "m", 1, 1}, {"y", "m", 1, 1}}, .z = {{"lambda", "N/m", 1}}};
  }
  static SceneEntry entry() {
    return {.id = "bead_cross",
            .title = "bead on crossing wires",
            .shows = "a singular position: no solution beyond the crossing",
            .collections = {"foreign"},
            .parameters = {numberParameter("force", "N", "force along the other wire", "1", 0.1, 10),
                           numberParameter("v0", "m/s", "speed; the crossing is 0.7 m away", "1", 0.25, 4)},
            .reference_cases = {{}}};
  }
};

}  // namespace

IRK_SCENE(CrossingWires)
