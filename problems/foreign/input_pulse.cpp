// y' = -y + 20 for 1 < t < 1 + width, else y' = -y: a short pulse of the input that the scene does not declare.
#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct InputPulse {
  Real width, y0;

  Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const bool on = p.t > T(1.0) && p.t < T(1 + width);
    r.x[0] = (on ? T(20.0) : T(0.0)) - p.x[0] - p.k[0];
  }
  static InputPulse with(const Settings& values) { return {number<Real>(values, "width"), number<Real>(values, "y0")}; }
  State<Real> exact(const Real& t) const {
    using std::exp;
    State<Real> s(sizes());
    s.t = t;
    const Real since = t - 1, before = since < width ? since : width;
    const Real input = since > 0 && since < width ? Real(20) : Real(0);
    s.x[0] = y0 * exp(Real(-t));
    if (since > 0) s.x[0] += 20 * (exp(Real(before - since)) - exp(Real(-since)));
    s.w[0] = input - s.x[0];
    return s;
  }
  SceneFrame<Real> frame() const { return {.t_end = 2, .x = {{"y"}}}; }
  static SceneEntry entry() {
    return {.id = "input_pulse",
            .title = "short pulse of the input, not declared",
            .shows = "an input between the stages of a step",
            .collections = {"foreign"},
            .parameters = {numberParameter("width", "s", "width of the pulse at t = 1", "0.05", 1e-3, 0.5),
                           numberParameter("y0", "", "start", "1", 0.5, 2)},
            .reference_cases = {{}}};
  }
};

}  // namespace

IRK_SCENE(InputPulse)
