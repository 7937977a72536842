// A Riccati equation: y' = -(y^2 - phi^2) + phi' with phi = 1.5 + sin t. The solution is y = phi. The problem is
// nonlinear and non-autonomous, because a linear, an autonomous or a quadrature problem does not reveal the errors
// of some damaged tableaus.
#include <cmath>

#include "irk/scene_file.h"

namespace irk {
namespace {

struct RiccatiTracking {
  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    const T phi = 1.5 + sin(p.t);
    r.x[0] = phi * phi - p.x[0] * p.x[0] + cos(p.t) - p.k[0];
  }
};

template <class Real>
Scene<Real> make(const Settings&) {
  Scene<Real> scene;
  setProblem(scene, RiccatiTracking{});
  scene.t_end = 2;
  scene.time_unit = "";
  setComponents(scene, {}, {{"y"}});
  scene.exact = [](const Real& t) {
    using std::cos;
    using std::sin;
    State<Real> s(RiccatiTracking{}.sizes());
    s.t = t;
    s.x[0] = sin(t) + 1.5;
    s.w[0] = cos(t);
    return s;
  };
  scene.start = scene.exact(Real(0));
  return scene;
}

}  // namespace

SceneEntry riccatiTrackingEntry() {
  return {.id = "riccati_tracking",
          .title = "y' = -(y^2 - phi^2) + phi', phi = 1.5 + sin t",
          .shows = "the order of a scheme: no damaged tableau passes it",
          .collections = {"probes"},
          .reference_cases = {{.times = "0.5 1", .tolerance = kManyDigits}},
          .make = make<double>,
          .make_mp50 = make<mp50>,
          .make_mp100 = make<mp100>};
}

}  // namespace irk
