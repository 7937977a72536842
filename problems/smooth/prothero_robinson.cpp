// Prothero & Robinson's problem: y' = lambda (y - phi) + phi' with phi = cos t. The solution is y = phi.
// HW II (IV.15).
#include <cmath>

#include "irk/scene_file.h"

namespace irk {
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
};

template <class Real>
Scene<Real> make(const Settings& settings) {
  const ProtheroRobinson<Real> problem{number<Real>(settings, "lambda")};
  Scene<Real> scene;
  setProblem(scene, problem);
  scene.t_end = 1;
  setComponents(scene, {}, {{"y"}});
  scene.exact = [problem](const Real& t) {
    using std::cos;
    using std::sin;
    State<Real> s(problem.sizes());
    s.t = t;
    s.x[0] = cos(t);
    s.w[0] = -sin(t);
    return s;
  };
  scene.start = scene.exact(Real(0));
  return scene;
}

}  // namespace

SceneEntry protheroRobinsonEntry() {
  return {.id = "prothero_robinson",
          .title = "y' = lambda (y - cos t) - sin t",
          .shows = "order reduction of stiff systems, one component, one parameter",
          .kind = SceneKind::kStiffTest,
          .stiffness = {.parameter = "lambda"},
          .parameters = {numberParameter("lambda", "1/s", "stiffness", "-1e8", -1e15, 1e15)},
          .reference_cases = {{.times = "0.25 0.5", .tolerance = kManyDigits}},
          .make = make<double>,
          .make_mp50 = make<mp50>};
}

}  // namespace irk
