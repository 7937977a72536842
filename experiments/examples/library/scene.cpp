/// @example scene.cpp
/// Scenes: the suite's with their reference values, and one of your own with a parameter.
#include <irk/collections.h>
#include <irk/integrator.h>
#include <irk/registration.h>
#include <irk/scene.h>
#include <irk/scene_file.h>
#include <irk/tableaus.h>
#include <irk/vanishes.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <string>

using namespace irk;

namespace {

// A mass on a spring: m u'' = -c u.
template <class Real>
struct Mass {
  Real m{1}, c{10};
  static Mass with(const Settings& values) { return {Real(1), number<Real>(values, "c")}; }
  Sizes sizes() const { return {.nu = 1}; }
  template <class T>
  void residual(const Point<T>& p, Rows<T> r) const {
    r.u[0] = -c * p.u[0];
    if (!vanishes(p.a)) r.u[0] -= m * p.a[0];  // left out where the Jacobian is taken without the mass
  }
  void start(State<Real>& s) const { s.u << 1; }
  SceneFrame<Real> frame() const { return {.t_end = 2, .u = {{"x", "m"}}}; }
  static SceneEntry entry() {
    return {.id = "mass",
            .title = "mass on a spring",
            .shows = "a parameter",
            .parameters = {positiveParameter("c", "N/m", "stiffness", "10")}};
  }
};

// The error at the end against the reference value that the catalogue keeps.
double errorOfSliderCrank() {
  const Scene<double> scene = makeScene<double>("slider_crank");
  IntegratorOptions options;
  options.tolerances = {.rtol = 1e-9, .atol = 1e-9};
  Integrator<double> integrator(scene.system({}), makeTableau<double>("radau_iia_5"), options, scene.scale);
  const auto solution = integrator.integrate(scene.start, scene.t_end);
  for (const Reference& reference : references("slider_crank")) {
    if (reference.t == scene.t_end && reference.component == scene.names[0])
      return std::abs(solution.state.u[0] - std::strtod(reference.value.c_str(), nullptr));
  }
  return 1;
}

}  // namespace

IRK_SCENE(Mass)

int main() {
  runRegistrations("");
  const Scene<double> mine = makeScene<double>("mass", {{"c", "40"}});
  std::cout << mine.id << ": " << mine.names[0] << " in " << mine.units[0] << '\n';
  std::cout << scenesOf("multibody").size() << " mechanisms, such as slider_crank with the error "
            << errorOfSliderCrank() << '\n';
  return mine.sizes().nu == 1 && errorOfSliderCrank() < 1e-7 ? 0 : 1;
}
