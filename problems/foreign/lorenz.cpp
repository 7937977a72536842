// Lorenz' system (J. Atmos. Sci. 20, 1963) from (1, 0, 0): with rho = 28 errors grow by about e^0.9 per unit of time.
#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct Lorenz {
  Real rho;

  Sizes sizes() const { return {.nx = 3}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = 10 * (p.x[1] - p.x[0]) - p.k[0];
    r.x[1] = p.x[0] * (rho - p.x[2]) - p.x[1] - p.k[1];
    r.x[2] = p.x[0] * p.x[1] - 8 * p.x[2] / 3 - p.k[2];
  }
  static Lorenz with(const Settings& values) { return {number<Real>(values, "rho")}; }
  void start(State<Real>& s) const { s.x[0] = 1; }
  SceneFrame<Real> frame() const {
    return {.t_end = 10, .time_unit = "", .x = {{"x", "", 10}, {"y", "", 10}, {"z", "", 10}}};
  }
  static SceneEntry entry() {
    return {.id = "lorenz",
            .title = "Lorenz' system",
            .shows = "chaos: errors of a step that grow without end",
            .collections = {"foreign"},
            .literature = "E. N. Lorenz, J. Atmos. Sci. 20 (1963)",
            .parameters = {numberParameter("rho", "", "Rayleigh number; the motion is chaotic from 24.74 on", "28", 20,
                                           60)},
            .reference_cases = {{}}};
  }
};

}  // namespace

IRK_SCENE(Lorenz)
