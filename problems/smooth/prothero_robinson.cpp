// Prothero & Robinson's problem: y' = lambda (y - phi) + phi' with phi = cos t. The solution is y = phi.
// HW II (IV.15).
#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct ProtheroRobinson {
  Real lambda;  // 1/s

  Sizes sizes() const { return {.nu = 0, .nx = 1, .nz = 0, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    using std::sin;
    r.x[0] = lambda * (p.x[0] - cos(p.t)) - sin(p.t) - p.k[0];
  }
  State<Real> exact(const Real& t) const {
    using std::cos;
    using std::sin;
    State<Real> s(sizes());
    s.t = t;
    s.x[0] = cos(t);
    s.w[0] = -sin(t);
    return s;
  }
  static ProtheroRobinson with(const Settings& values) { return {number<Real>(values, "lambda")}; }
  SceneFrame<Real> frame() const { return {.t_end = 1, .x = {{"y"}}}; }
  static SceneEntry entry() {
    return {.id = "prothero_robinson",
            .title = "y' = lambda (y - cos t) - sin t",
            .shows = "order reduction of stiff systems, one component, one parameter",
            .collections = {"probes"},
            .literature = "A. Prothero, A. Robinson, Math. Comp. 28 (1974) 145-162",
            .kind = SceneKind::kStiffTest,
            .stiffness = {.parameter = "lambda"},
            .parameters = {numberParameter("lambda", "1/s", "stiffness", "-1e8", -1e15, 1e15)},
            .reference_cases = {{.times = "0.25 0.5", .tolerance = kManyDigits}}};
  }
};

}  // namespace

IRK_SCENE(ProtheroRobinson)
