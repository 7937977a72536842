// y' = L (y - cos t) - sin t with L > 0: from y(0) = 1 the solution is cos t, and an error grows by e^L per unit of
// time.
#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct UnstableMotion {
  Real L, offset;

  Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    r.x[0] = L * (p.x[0] - cos(p.t)) - sin(p.t) - p.k[0];
  }
  static UnstableMotion with(const Settings& values) {
    return {number<Real>(values, "L"), number<Real>(values, "offset")};
  }
  State<Real> exact(const Real& t) const {
    using std::cos;
    using std::exp;
    using std::sin;
    State<Real> s(sizes());
    s.t = t;
    const Real grown = offset * exp(Real(L * t));
    s.x[0] = cos(t) + grown;
    s.w[0] = L * grown - sin(t);
    return s;
  }
  SceneFrame<Real> frame() const { return {.t_end = 1, .time_unit = "", .x = {{"y"}}}; }
  static SceneEntry entry() {
    return {.id = "unstable",
            .title = "y' = L (y - cos t) - sin t, an unstable solution cos t",
            .shows = "errors of a step that grow by e^L per unit of time",
            .collections = {"foreign"},
            .parameters = {numberParameter("L", "", "growth of errors per unit of time", "5", 1, 100),
                           numberParameter("offset", "", "distance of the start from 1", "0", -1e-3, 1e-3)},
            .reference_cases = {{}}};
  }
};

}  // namespace

IRK_SCENE(UnstableMotion)
