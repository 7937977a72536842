// y' = y^2: the solution y0 / (1 - y0 t) has a pole at t = 1 / y0, over which a step can go.
#include <limits>

#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct BlowUp {
  Real y0;

  Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = p.x[0] * p.x[0] - p.k[0];
  }
  static BlowUp with(const Settings& values) { return {number<Real>(values, "y0")}; }
  State<Real> exact(const Real& t) const {
    State<Real> s(sizes());
    s.t = t;
    const Real left = 1 - y0 * t;
    s.x[0] = left > 0 ? Real(y0 / left) : std::numeric_limits<Real>::infinity();
    s.w[0] = s.x[0] * s.x[0];
    return s;
  }
  SceneFrame<Real> frame() const { return {.t_end = 0.8, .time_unit = "", .x = {{"y"}}}; }
  static SceneEntry entry() {
    return {.id = "blow_up",
            .title = "y' = y^2, whose solution has a pole",
            .shows = "no solution beyond 1 / y0: no success there is right",
            .collections = {"foreign"},
            .parameters = {numberParameter("y0", "", "start", "1", 0.25, 4)},
            .reference_cases = {{}}};
  }
};

}  // namespace

IRK_SCENE(BlowUp)
