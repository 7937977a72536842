// A small mechanical system with gyroscopic and nonlinear forces, for measuring the orders of q, v and lambda:
// M = diag(1, 2), constraint x^2 + y^2 (1 + 0.3 x) = 1.
#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct MechanicalDae {
  Real skew = decimal<Real>("0.3"), gyro = decimal<Real>("0.2");

  Sizes sizes() const { return {.nu = 2, .nx = 0, .nz = 1, .constraints = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T &x = p.u[0], &y = p.u[1], &lambda = p.z[0];
    const T square = y * y;
    r.u[0] = -x - gyro * (p.v[0] * p.v[1]) - p.a[0] - (2 * x + skew * square) * lambda;
    r.u[1] = -2 - 0.5 * (square * x) - 2 * p.a[1] - 2 * (y * (1 + skew * x)) * lambda;
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& g) const {
    g[0] = u[0] * u[0] + u[1] * u[1] * (1 + skew * u[0]) - 1;
  }
  void start(State<Real>& s) const {
    s.u[0] = Real(1);
    s.v[1] = Real(0.5);
  }
  SceneFrame<Real> frame() const { return {.t_end = 1, .time_unit = "", .u = {{"x"}, {"y"}}, .z = {{"lambda"}}}; }
  static SceneEntry entry() {
    return {.id = "mechanical_dae",
            .title = "two coordinates on a curve, gyroscopic and nonlinear forces",
            .shows = "orders of q, v and lambda in every formulation",
            .collections = {"probes"},
            .reference_cases = {{.times = "0.25 0.5", .tolerance = kManyDigits}}};
  }
};

}  // namespace

IRK_SCENE(MechanicalDae)
