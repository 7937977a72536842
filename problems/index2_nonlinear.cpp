// A nonlinear DAE of index 2 after Hairer, Lubich & Roche (LNM 1409, 1989); y = (exp t, exp -2t),
// z = exp 2t. z enters nonlinearly: no multiplier of a position constraint.
#include <cmath>

#include "problems/build.h"
#include "problems/entries.h"

namespace irk {
namespace {

struct Index2Nonlinear {
  Sizes sizes() const { return {.nu = 0, .nx = 2, .nz = 1, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T &y1 = p.x[0], &y2 = p.x[1], &z = p.z[0];
    const T square = y2 * y2;
    r.x[0] = y1 * square * z * z - p.k[0];
    r.x[1] = y1 * y1 * square - 3 * (square * z) - p.k[1];
    r.z[0] = y1 * y1 * y2 - 1;
  }
};

template <class Real>
Scene<Real> make(const Settings&) {
  Scene<Real> scene;
  scene.id = "index2_nonlinear";
  setProblem(scene, Index2Nonlinear{});
  scene.t_end = 1;
  scene.names = componentNames({}, {"y1", "y2"}, {"z"});
  scene.scale = scales({1, 1, 1});
  scene.exact = [](const Real& t) {
    using std::exp;
    State<Real> s(Index2Nonlinear{}.sizes());
    s.t = t;
    s.x << exp(t), exp(-2 * t);
    s.w << s.x[0], -2 * s.x[1], exp(2 * t);
    return s;
  };
  scene.start = scene.exact(Real(0));
  return scene;
}

}  // namespace

SceneEntry index2NonlinearEntry() {
  return {.id = "index2_nonlinear",
          .title = "nonlinear DAE of index 2, exactly solvable",
          .shows = "orders of differential and algebraic unknowns, index 2",
          .parameters = {},
          .make = make<double>,
          .make_mp50 = make<mp50>};
}

}  // namespace irk
