/// @example error_bar.cpp
/// How good is a result? Its distance from a second integration with another family and a tenth of the tolerance.
#include <irk/error_bar.h>
#include <irk/integrator.h>
#include <irk/problem.h>
#include <irk/tableaus.h>

#include <cmath>
#include <iostream>

namespace {

// u'' = -u with u(0) = 1, u'(0) = 0: u = cos t.
struct Oscillator {
  irk::Sizes sizes() const { return {.nu = 1}; }
  template <class T>
  void residual(const irk::Point<T>& p, irk::Rows<T> r) const {
    r.u[0] = -p.u[0] - p.a[0];
  }
};

}  // namespace

int main() {
  const auto system = irk::makeSystem<double>(Oscillator{});
  irk::State<double> start(system->sizes());
  start.u << 1;
  irk::IntegratorOptions options;
  options.tolerances = {.rtol = 1e-6, .atol = 1e-6};
  irk::Integrator<double> first(system, irk::makeTableau<double>("radau_iia_3"), options);
  const auto result = first.integrate(start, 10.0);

  const auto second_options = irk::independentOptions<double>(options);
  irk::Integrator<double> second(system, irk::makeMethods<double>("lobatto_iiic_3", 13, 3), second_options);
  irk::Solution<double> better;
  const irk::ErrorBar bar = irk::measureErrorBar(result.state, second, start, options.tolerances, {}, better);
  if (!bar.known()) {
    std::cout << bar.problem << '\n';
    return 1;
  }
  const double error = std::abs(result.state.u[0] - std::cos(10.0));
  std::cout << result.state.u[0] << " +- " << bar.u[0] << ", true error " << error << '\n';
  return bar.u[0] > error / 2 && bar.tolerances < irk::largestErrorBar(options.tolerances) ? 0 : 1;
}
