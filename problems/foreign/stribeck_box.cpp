// A box on an oscillating table: Coulomb friction with Stribeck's decrease, regularised over a stiction velocity, in
// the smooth steps of multibody programs.
#include "irk/scene_file.h"

using namespace irk;

namespace {

template <class Real>
struct StribeckBox {
  Real vs;                                                       // m/s
  Real mu_s = 1, mu_d = Real(1) / 2, g = decimal<Real>("9.81");  // -, -, m/s^2

  Sizes sizes() const { return {.nu = 1}; }
  template <class T>
  static T smooth(const T& x) {
    return x * x * x * (10 + x * (6 * x - 15));
  }
  // The coefficient of friction at `slip` stiction velocities: rises to mu_s at 1, falls to mu_d at 3.
  template <class T>
  T friction(const T& slip) const {
    if (slip >= T(3.0)) return T(mu_d);
    if (slip >= T(1.0)) return T(mu_s - (mu_s - mu_d) * smooth<T>((slip - 1) / 2));
    return T(mu_s * smooth<T>(slip));
  }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    using std::cos;
    const T slip = (p.v[0] - 2 * cos(5 * p.t)) / vs;
    const T mu = slip > T(0.0) ? T(friction<T>(slip)) : T(-friction<T>(-slip));
    r.u[0] = -mu * g - p.a[0];
  }
  static StribeckBox with(const Settings& values) { return {number<Real>(values, "vs")}; }
  void start(State<Real>&) const {}
  SceneFrame<Real> frame() const { return {.t_end = 2, .u = {{"x", "m", 0.1, 1}}}; }
  static SceneEntry entry() {
    return {.id = "stribeck_box",
            .title = "box on an oscillating table, regularised Stribeck friction",
            .shows = "a force that changes within a very narrow range of the velocity",
            .collections = {"foreign"},
            .parameters = {numberParameter("vs", "m/s", "stiction velocity", "0.01", 1e-4, 0.1)},
            .reference_cases = {{.tolerance = kFewDigits}}};
  }
};

}  // namespace

IRK_SCENE(StribeckBox)
