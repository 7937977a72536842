// Kaps' problem: y1' = -(2 + 1/eps) y1 + y2^2 / eps, y2' = y1 - y2 - y2^2. The solution is y = (exp -2t, exp -t)
// for every eps.
#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct Kaps {
  Real eps;

  Sizes sizes() const { return {.nu = 0, .nx = 2, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T square = p.x[1] * p.x[1];
    r.x[0] = (square - p.x[0]) / eps - 2 * p.x[0] - p.k[0];
    r.x[1] = p.x[0] - p.x[1] - square - p.k[1];
  }
  State<Real> exact(const Real& t) const {
    using std::exp;
    State<Real> s(sizes());
    s.t = t;
    s.x << exp(-2 * t), exp(-t);
    s.w << -2 * s.x[0], -s.x[1];
    return s;
  }
  static Kaps with(const Settings& values) { return {number<Real>(values, "eps")}; }
  SceneFrame<Real> frame() const { return {.t_end = 1, .time_unit = ""}; }
  static SceneEntry entry() {
    return {.id = "kaps",
            .title = "Kaps' problem, singularly perturbed with a smooth exact solution",
            .shows = "order reduction of a nonlinear stiff system; index 1 as eps vanishes",
            .collections = {"probes"},
            .kind = SceneKind::kSingularlyPerturbed,
            .stiffness = {.parameter = "eps", .reciprocal = true},
            .parameters = {numberParameter("eps", "", "1 / stiffness", "1e-6", 1e-15, 1e3)},
            .reference_cases = {{.times = "0.25 0.5", .tolerance = kManyDigits}}};
  }
};

}  // namespace

IRK_SCENE(Kaps)
