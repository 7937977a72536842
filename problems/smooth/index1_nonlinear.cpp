// A nonlinear DAE of index 1 after Hairer, Lubich & Roche (LNM 1409, 1989). Its solution is y = (exp t, exp -2t),
// z = exp 2t.
#include "problems/smooth/exponentials.h"

using namespace irk;

namespace {

template <class Real>
struct Index1Nonlinear {
  static constexpr int kAlgebraicIndex = 1;

  Sizes sizes() const { return {.nu = 0, .nx = 2, .nz = 1, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T &y1 = p.x[0], &y2 = p.x[1], &z = p.z[0];
    r.x[0] = y1 * y2 * z - p.k[0];
    r.x[1] = -2 * (y2 * y2 * z) - p.k[1];
    r.z[0] = z * z * y2 - y1 * y1;
  }
  State<Real> exact(const Real& t) const { return exponentials(sizes(), t, std::array{1, -2, 2}); }
  SceneFrame<Real> frame() const { return {.t_end = 1, .time_unit = "", .x = {{"y1"}, {"y2"}}, .z = {{"z"}}}; }
  static SceneEntry entry() {
    return {.id = "index1_nonlinear",
            .title = "nonlinear DAE of index 1, exactly solvable",
            .shows = "orders of differential and algebraic unknowns, index 1",
            .collections = {"probes"},
            .kind = SceneKind::kIndex1,
            .reference_cases = {{.times = "0.25 0.5", .tolerance = kManyDigits}}};
  }
};

}  // namespace

IRK_SCENE(Index1Nonlinear)
