// The Oregonator: the Belousov-Zhabotinskii reaction (Field, Noyes). IVP test set, OREGO; HW II (IV.10).
#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct Oregonator {
  Real s = decimal<Real>("77.27"), w = decimal<Real>("0.161"), q = decimal<Real>("8.375e-6");

  Sizes sizes() const { return {.nx = 3}; }
  bool nonNegative(Index) const { return true; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    const T &y1 = p.x[0], &y2 = p.x[1], &y3 = p.x[2];
    r.x[0] = s * (y2 - y1 * y2 + y1 - q * (y1 * y1)) - p.k[0];
    r.x[1] = (y3 - y2 - y1 * y2) / s - p.k[1];
    r.x[2] = w * (y1 - y3) - p.k[2];
  }
  void start(State<Real>& state) const { state.x << Real(1), Real(2), Real(3); }
  SceneFrame<Real> frame() const { return {.t_end = 360}; }
  static SceneEntry entry() {
    return {.id = "orego",
            .title = "Oregonator: an oscillating chemical reaction",
            .shows = "steps over ten decades: slow drifts and fast transitions",
            .collections = {"ivp"},
            .literature = "IVP test set, OREGO; HW II (IV.10)",
            .reference_cases = {{.times = "30 180", .tolerance = kManyDigits}}};
  }
};

}  // namespace

IRK_SCENE(Oregonator)
