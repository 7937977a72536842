// y' = -1 / y: the solution sqrt(y0^2 - 2 t) ends at t = y0^2 / 2, with an infinite slope.
#include <limits>

#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct SolutionEnd {
  Real y0;

  Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = -1 / p.x[0] - p.k[0];
  }
  static SolutionEnd with(const Settings& values) { return {number<Real>(values, "y0")}; }
  State<Real> exact(const Real& t) const {
    using std::sqrt;
    State<Real> s(sizes());
    s.t = t;
    const Real square = y0 * y0 - 2 * t;
    s.x[0] = square > 0 ? Real(sqrt(square)) : std::numeric_limits<Real>::infinity();
    s.w[0] = -1 / s.x[0];
    return s;
  }
  SceneFrame<Real> frame() const { return {.t_end = 0.4, .time_unit = "", .x = {{"y"}}}; }
  static SceneEntry entry() {
    return {.id = "solution_end",
            .title = "y' = -1/y, whose solution ends",
            .shows = "no solution beyond y0^2 / 2: no success there is right",
            .collections = {"foreign"},
            .parameters = {numberParameter("y0", "", "start", "1", 0.25, 4)},
            .reference_cases = {{}}};
  }
};

}  // namespace

IRK_SCENE(SolutionEnd)
