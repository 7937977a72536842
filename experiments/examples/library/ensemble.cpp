/// @example ensemble.cpp
/// Twenty oscillators with different stiffness, eight at a time in the lanes of a vector register.
#include <irk/ensemble.h>
#include <irk/lanes.h>
#include <irk/problem.h>
#include <irk/tableaus.h>

#include <array>
#include <cmath>
#include <iostream>
#include <memory>
#include <optional>

namespace {

// x' = -c (x - cos t). Real is double, or Lanes: eight values of c side by side.
template <class Real>
struct Tracking {
  Real c;
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
  irk::Ensemble ensemble;
  ensemble.member = [](std::size_t i) {
    irk::EnsembleMember member;
    member.system = irk::makeSystem<double>(Tracking<double>{stiffness(i)});
    member.start = irk::State<double>(member.system->sizes());
    member.t_end = 2;
    return member;
  };
  ensemble.lanes = [](const std::array<std::size_t, irk::kLanes>& at) {
    irk::Lanes c;
    for (std::size_t k = 0; k < irk::kLanes; ++k) c.set(k, stiffness(at[k]));
    return irk::makeSystem<irk::Lanes>(Tracking<irk::Lanes>{c});
  };
  irk::IntegratorOptions options;
  options.tolerances = {.rtol = 1e-8, .atol = 1e-8};
  irk::LaneIntegrator integrator(irk::makeTableau<double>("radau_iia_3"), irk::laneOptions(options));

  std::size_t begun = 0, good = 0;
  const auto next = [&]() -> std::optional<std::size_t> {
    if (begun == kMembers) return {};
    return begun++;
  };
  integrator.integrate(ensemble, next, [&](std::size_t i, const irk::Solution<double>& solution) {
    const double c = stiffness(i), t = 2;
    const double exact = (c * c * std::cos(t) + c * std::sin(t)) / (1 + c * c) - c * c / (1 + c * c) * std::exp(-c * t);
    if (solution.outcome == irk::Outcome::kSuccess && std::abs(solution.state.x[0] - exact) < 1e-6) ++good;
  });
  std::cout << good << " of " << kMembers << " right\n";
  return good == kMembers ? 0 : 1;
}
