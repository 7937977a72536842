// A Riccati equation: y' = -(y^2 - phi^2) + phi' with phi = 1.5 + sin t. The solution is y = phi. The problem is
// nonlinear and non-autonomous, because a linear, an autonomous or a quadrature problem does not reveal the errors
// of some damaged tableaus.
#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct RiccatiTracking {
  Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    const T phi = 1.5 + sin(p.t);
    r.x[0] = phi * phi - p.x[0] * p.x[0] + cos(p.t) - p.k[0];
  }
  State<Real> exact(const Real& t) const {
    using std::cos;
    using std::sin;
    State<Real> s(sizes());
    s.t = t;
    s.x[0] = sin(t) + 1.5;
    s.w[0] = cos(t);
    return s;
  }
  SceneFrame<Real> frame() const { return {.t_end = 2, .time_unit = "", .x = {{"y"}}}; }
  static SceneEntry entry() {
    return {.id = "riccati_tracking",
            .title = "y' = -(y^2 - phi^2) + phi', phi = 1.5 + sin t",
            .shows = "the order of a scheme: no damaged tableau passes it",
            .collections = {"probes"},
            .reference_cases = {{.times = "0.5 1", .tolerance = kManyDigits}}};
  }
};

}  // namespace

IRK_SCENE(RiccatiTracking)
