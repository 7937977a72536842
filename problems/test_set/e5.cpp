// E5: a chemical pyrolysis to t = 1e13 (Enright, Hull, Lindberg). IVP test set, E5; HW II (IV.10).
//
// The test set writes y3' = y2' - y4'. Here the integral y2 = y3 + y4 replaces the equation of y2': in double precision
// the sum of all increments would give y2 an error of 1e-26, which is 1e-4 of its last value. The end values that are
// printed in the IVP test set are wrong from the third digit on: they contradict this integral.
#include "irk/scene_file.h"

using namespace irk;

namespace {

// The magnitude of all components. It is small because y3 falls to 9e-23 and still matters. The codes of the test set
// are run with atol = 1.7e-24.
constexpr double kScale = 1.7e-24;

template <class Real>
struct E5 {
  Real A = decimal<Real>("7.89e-10"), B = decimal<Real>("1.1e7"), CM = decimal<Real>("1.13e9");
  Real C = decimal<Real>("1.13e3");

  Sizes sizes() const { return {.nx = 3, .nz = 1}; }
  bool nonNegative(Index) const { return true; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T &y1 = p.x[0], &y3 = p.x[1], &y4 = p.x[2], &y2 = p.z[0];
    const T first = B * (y1 * y3);
    r.x[0] = -A * y1 - first - p.k[0];
    r.x[1] = A * y1 - CM * (y2 * y3) - p.k[2] - p.k[1];
    r.x[2] = first - C * y4 - p.k[2];
    r.z[0] = y3 + y4 - y2;
  }
  void start(State<Real>& s) const { s.x[0] = decimal<Real>("1.76e-3"); }
  SceneFrame<Real> frame() const {
    return {
        .t_end = 1e13, .x = {{"y1", "", kScale}, {"y3", "", kScale}, {"y4", "", kScale}}, .z = {{"y2", "", kScale}}};
  }
  static SceneEntry entry() {
    return {.id = "e5",
            .title = "E5: chemical pyrolysis to t = 1e13",
            .shows = "components down to 1e-22 over thirteen decades of time, cancellation",
            .collections = {"ivp"},
            .literature = "IVP test set, E5; HW II (IV.10)",
            .kind = SceneKind::kIndex1,
            .reference_cases = {{.times = "10 1e5 1e9 1e11"}}};
  }
};

}  // namespace

IRK_SCENE(E5)
