/// @example checks.cpp
/// What is refused before the first step, and the ids of strategies.
#include <irk/misuse.h>
#include <irk/options.h>
#include <irk/problem.h>
#include <irk/strategy_id.h>
#include <irk/system_check.h>

#include <iostream>
#include <limits>
#include <string>

namespace {

struct Decay {
  irk::Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const irk::Point<T>& p, irk::Rows<T> r) const {
    r.x[0] = -p.x[0] - p.k[0];
  }
};

// Prints the message; whether the function throws Misuse.
template <class F>
bool refuses(F&& f) {
  try {
    f();
  } catch (const irk::Misuse& misuse) {
    std::cout << misuse.what() << '\n';
    return true;
  }
  return false;
}

}  // namespace

int main() {
  const auto system = irk::makeSystem<double>(Decay{});
  irk::State<double> start(system->sizes());
  irk::requireSystem(system.get(), {});
  irk::requireStart(*system, start, 1.0);
  bool all = refuses([&] { irk::requireStart(*system, start, -1.0); });
  all = refuses([] { irk::requireSizes({.nz = 1, .constraints = 2}); }) && all;
  start.x << std::numeric_limits<double>::infinity();
  std::cout << irk::notFinite(start) << '\n';
  return all && irk::notFinite(start) == "x[0] = inf" && irk::StepControl::kFixed != irk::StepControl::kPredictive ? 0
                                                                                                                   : 1;
}
