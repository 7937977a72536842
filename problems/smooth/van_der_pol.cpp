// Van der Pol's equation, singularly perturbed: y1' = y2, eps y2' = (1 - y1^2) y2 - y1. HW II
// (IV.10), whose start lies near the slow manifold. The IVP test set's VDPOL starts at (2, 0); its digits belong to
// that start.
#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct VanDerPol {
  Real eps, start_y2;

  Sizes sizes() const { return {.nu = 0, .nx = 2, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.x[0] = p.x[1] - p.k[0];
    r.x[1] = ((1 - p.x[0] * p.x[0]) * p.x[1] - p.x[0]) / eps - p.k[1];
  }
  static VanDerPol with(const Settings& values) {
    return {number<Real>(values, "eps"), number<Real>(values, "start_y2")};
  }
  void start(State<Real>& s) const { s.x << Real(2), start_y2; }
  SceneFrame<Real> frame() const { return {.t_end = 2, .time_unit = ""}; }
  static SceneEntry entry() {
    return {.id = "van_der_pol",
            .title = "van der Pol's equation, eps y2' = (1 - y1^2) y2 - y1",
            .shows = "stiffness with fast transitions: step control and Newton",
            .collections = {"ivp"},
            .literature = "HW II (IV.10); with start_y2=0 the IVP test set, VDPOL",
            .kind = SceneKind::kSingularlyPerturbed,
            .stiffness = {.parameter = "eps", .reciprocal = true},
            .parameters = {numberParameter("eps", "", "1 / stiffness", "1e-6", 1e-15, 1e3),
                           numberParameter("start_y2", "", "y2 at the start; IVP test set: 0", "-0.66", -1e3, 1e3)},
            .panels = {{"y1", {"y1"}}, {"y2", {"y2"}, "1e6", 1e-6}},
            .reference_cases = {{.times = "0.2 0.4 0.5 0.6 0.8 1 1.2 1.4 1.6 1.8", .tolerance = kManyDigits}}};
  }
};

}  // namespace

IRK_SCENE(VanDerPol)
