// A population whose growth rate changes with the season: y' = A cos(t) y (1 - y). It falls to about e^-A and recovers;
// below zero it would fall without end.
#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct NearExtinction {
  Real A, y0;

  Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    r.x[0] = A * cos(p.t) * p.x[0] * (1 - p.x[0]) - p.k[0];
  }
  static NearExtinction with(const Settings& values) { return {number<Real>(values, "A"), number<Real>(values, "y0")}; }
  State<Real> exact(const Real& t) const {
    using std::cos;
    using std::exp;
    using std::sin;
    State<Real> s(sizes());
    s.t = t;
    const Real y = 1 / (1 + (1 / y0 - 1) * exp(Real(-A * sin(t))));
    s.x[0] = y;
    s.w[0] = A * cos(t) * y * (1 - y);
    return s;
  }
  SceneFrame<Real> frame() const { return {.t_end = 6, .time_unit = "", .x = {{"y"}}}; }
  static SceneEntry entry() {
    return {.id = "extinction",
            .title = "population near extinction",
            .shows = "a component that falls far below its tolerance and recovers",
            .collections = {"foreign"},
            .parameters = {numberParameter("A", "", "largest growth rate; the population falls to e^-A", "5", 1, 40),
                           numberParameter("y0", "", "population at the start", "0.5", 0.1, 0.9)},
            .reference_cases = {{}}};
  }
};

}  // namespace

IRK_SCENE(NearExtinction)
