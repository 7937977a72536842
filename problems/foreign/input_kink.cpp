// y' = -y + slope max(0, t - at): a kink of the input that the scene does not declare.
#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct InputKink {
  Real slope, at, y0;

  Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T since = p.t - at;
    r.x[0] = (since > T(0.0) ? T(slope * since) : T(0.0)) - p.x[0] - p.k[0];
  }
  static InputKink with(const Settings& values) {
    return {number<Real>(values, "slope"), number<Real>(values, "at"), number<Real>(values, "y0")};
  }
  State<Real> exact(const Real& t) const {
    using std::exp;
    State<Real> s(sizes());
    s.t = t;
    const Real since = t > at ? Real(t - at) : Real(0);
    s.x[0] = y0 * exp(Real(-t)) + slope * (since - 1 + exp(Real(-since)));
    s.w[0] = slope * since - s.x[0];
    return s;
  }
  SceneFrame<Real> frame() const { return {.t_end = 2, .x = {{"y"}}}; }
  static SceneEntry entry() {
    return {.id = "input_kink",
            .title = "kink of the input, not declared",
            .shows = "a derivative that jumps between the stages of a step",
            .collections = {"foreign"},
            .parameters = {numberParameter("slope", "1/s", "of the input behind the kink", "10", 1, 100),
                           numberParameter("at", "s", "time of the kink", "1", 0.2, 1.8),
                           numberParameter("y0", "", "start", "1", 0.5, 2)},
            .reference_cases = {{}}};
  }
};

}  // namespace

IRK_SCENE(InputKink)
