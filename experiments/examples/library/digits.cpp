/// @example digits.cpp
/// The order of a method in 50 digits, and derivatives by dual numbers.
#include <irk/dual.h>
#include <irk/integrator.h>
#include <irk/multiprecision.h>
#include <irk/problem.h>
#include <irk/tableaus.h>

#include <cmath>
#include <iostream>

namespace {

// x' = x cos t, x(0) = 1: x = exp(sin t).
struct Swing {
  irk::Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const irk::Point<T>& p, irk::Rows<T> r) const {
    using std::cos;
    r.x[0] = p.x[0] * cos(p.t) - p.k[0];
  }
};

irk::BigFloat errorWith(double h) {
  const auto system = irk::makeSystem<irk::BigFloat>(Swing{});
  irk::State<irk::BigFloat> start(system->sizes());
  start.x[0] = 1;
  irk::IntegratorOptions options;
  options.step.control = irk::StepControl::kFixed;
  options.step.h = h;
  options.step.estimate = irk::ErrorEstimate::kNone;
  options.tolerances = {.rtol = 1e-40, .atol = 1e-40};
  irk::Integrator<irk::BigFloat> integrator(system, irk::makeTableau<irk::BigFloat>("gauss_5"), options);
  const auto solution = integrator.integrate(start, irk::BigFloat(1));
  return abs(solution.state.x[0] - exp(sin(irk::BigFloat(1))));
}

}  // namespace

int main() {
  const double order = std::log2(static_cast<double>(errorWith(0.125) / errorWith(0.0625)));
  std::cout << "order of Gauss with 5 stages: " << order << '\n';

  irk::Rate<double> x{2.0, 1.0};  // a value, and its derivative by itself
  const auto f = x * exp(x);
  std::cout << "d/dx x exp(x) at 2: " << f.d[0] << '\n';
  return std::abs(order - 10) < 0.3 && std::abs(f.d[0] - 3 * std::exp(2.0)) < 1e-12 ? 0 : 1;
}
