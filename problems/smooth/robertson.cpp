// Robertson's chemical kinetics to t = 1e11. HW II (IV.10), "ROBER".
#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct Robertson {
  Real slow = decimal<Real>("0.04");

  Sizes sizes() const { return {.nu = 0, .nx = 3, .nz = 0, .constraints = 0}; }
  bool nonNegative(Index) const { return true; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T first = slow * p.x[0];
    const T second = 1e4 * (p.x[1] * p.x[2]);
    const T third = 3e7 * (p.x[1] * p.x[1]);
    r.x[0] = second - first - p.k[0];
    r.x[1] = first - second - third - p.k[1];
    r.x[2] = third - p.k[2];
  }
  void start(State<Real>& s) const { s.x[0] = Real(1); }
  // As in HW II (IV.10): Atol = 1e-6 Rtol.
  SceneFrame<Real> frame() const { return {.t_end = 1e11, .x = numbered(3, "y", "", 1e-6)}; }
  static SceneEntry entry() {
    return {.id = "robertson",
            .title = "Robertson's chemical kinetics to t = 1e11",
            .shows = "eleven decades of time, a component that falls to 1e-13",
            .collections = {"ivp"},
            .literature = "IVP test set, ROBER; HW II (IV.10)",
            .reference_cases = {
                {.times = "0.4 4e3 1e7 1e10 2e10 3e10 4e10 5e10 6e10 7e10 8e10 9e10", .tolerance = kManyDigits}}};
  }
};

}  // namespace

IRK_SCENE(Robertson)
