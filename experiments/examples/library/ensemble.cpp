/// @example ensemble.cpp
/// Twenty oscillators with different stiffness on two threads: one method for all, a system and an integrator for each.
#include <irk/integrator.h>
#include <irk/problem.h>
#include <irk/tableaus.h>

#include <array>
#include <atomic>
#include <cmath>
#include <iostream>
#include <thread>

namespace {

// x' = -c (x - cos t).
struct Tracking {
  double c;
  irk::Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const irk::Point<T>& p, irk::Rows<T> r) const {
    using std::cos;
    r.x[0] = -c * (p.x[0] - cos(p.t)) - p.k[0];
  }
};

constexpr std::size_t kMembers = 20;
double stiffness(std::size_t i) { return std::pow(10.0, static_cast<double>(i) / 5); }

}  // namespace

int main() {
  irk::IntegratorOptions options;
  options.tolerances = {.rtol = 1e-8, .atol = 1e-8};
  const auto method = irk::makeTableau<double>("radau_iia_3");

  std::array<irk::Solution<double>, kMembers> solutions;
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < kMembers; i = next++) {
      const auto system = irk::makeSystem<double>(Tracking{stiffness(i)});
      irk::Integrator<double> integrator(system, method, options);
      solutions[i] = integrator.integrate(irk::State<double>(system->sizes()), 2);
    }
  };
  std::thread other(work);
  work();
  other.join();

  std::size_t good = 0;
  for (std::size_t i = 0; i < kMembers; ++i) {
    const double c = stiffness(i), t = 2;
    const double exact = (c * c * std::cos(t) + c * std::sin(t)) / (1 + c * c) - c * c / (1 + c * c) * std::exp(-c * t);
    const bool solved = solutions[i].outcome == irk::Outcome::kSuccess;
    if (solved && std::abs(solutions[i].state.x[0] - exact) < 1e-6) ++good;
  }
  std::cout << good << " of " << kMembers << " right\n";
  return good == kMembers ? 0 : 1;
}
