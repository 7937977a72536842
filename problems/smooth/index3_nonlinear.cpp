// A nonlinear DAE of index 3 after Jay (Appl. Numer. Math. 17, 1995, section 7). Its solution is
// y = z = (exp 2t, exp -t), w = exp t. z enters y' nonlinearly: y and z are not positions and velocities.
#include "problems/smooth/exponentials.h"

using namespace irk;

namespace {

template <class Real>
struct Index3Nonlinear {
  static constexpr int kAlgebraicIndex = 3;
  static constexpr std::array kDifferentialIndices = {1, 1, 2, 2};

  Sizes sizes() const { return {.nu = 0, .nx = 4, .nz = 1, .constraints = 0}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T &y1 = p.x[0], &y2 = p.x[1], &z1 = p.x[2], &z2 = p.x[3], &w = p.z[0];
    const T square = z2 * z2;
    r.x[0] = 2 * (y1 * y2 * z1 * z2) - p.k[0];
    r.x[1] = -(y1 * y2 * square) - p.k[1];
    r.x[2] = (y1 * y2 + z1 * z2) * w - p.k[2];
    r.x[3] = -(y1 * y2 * y2 * square * w) - p.k[3];
    r.z[0] = y1 * y2 * y2 - 1;
  }
  State<Real> exact(const Real& t) const { return exponentials(sizes(), t, std::array{2, -1, 2, -1, 1}); }
  SceneFrame<Real> frame() const {
    return {.t_end = 1, .time_unit = "", .x = {{"y1"}, {"y2"}, {"z1"}, {"z2"}}, .z = {{"w"}}};
  }
  static SceneEntry entry() {
    return {.id = "index3_nonlinear",
            .title = "nonlinear DAE of index 3, exactly solvable",
            .shows = "orders of differential and algebraic unknowns, index 3",
            .collections = {"probes"},
            .kind = SceneKind::kIndex3,
            .reference_cases = {{.times = "0.25 0.5", .step = 0.1}}};
  }
};

}  // namespace

IRK_SCENE(Index3Nonlinear)
