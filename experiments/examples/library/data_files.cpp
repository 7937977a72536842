/// @example data_files.cpp
/// A load that is read from a file beside this one. In a scene of your own the name makes the file part of the scene.
#include <irk/data_files.h>
#include <irk/integrator.h>
#include <irk/problem.h>
#include <irk/tableaus.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <vector>

IRK_DATA_FILES("load.dat")

namespace {

// x' = load(t), linear between the times of the file, whose kinks are times at which steps end.
struct Loaded {
  std::vector<double> t, f;

  explicit Loaded(const std::string& path) {
    std::ifstream file(path);
    for (double time = 0, load = 0; file >> time >> load;) {
      t.push_back(time);
      f.push_back(load);
    }
  }
  irk::Sizes sizes() const { return {.nx = 1}; }
  template <class T>
  void residual(const irk::Point<T>& p, irk::Rows<T> r) const {
    std::size_t i = 0;
    while (i + 2 < t.size() && p.t > T(t[i + 1])) ++i;
    r.x[0] = p.k[0] - f[i] - (f[i + 1] - f[i]) / (t[i + 1] - t[i]) * (p.t - t[i]);
  }
  std::vector<double> times() const { return t; }
};

}  // namespace

int main() {
  const Loaded problem(irk::dataFile("load.dat", __FILE__));
  if (problem.t.size() != 4) {
    std::cout << "load.dat cannot be read\n";
    return 1;
  }
  const auto system = irk::makeSystem<double>(problem);
  irk::State<double> start(system->sizes());
  irk::Integrator<double> integrator(system, irk::makeTableau<double>("radau_iia_3"), {});
  const auto result = integrator.integrate(start, 4.0);
  std::cout << "area under the load: " << result.state.x[0] << '\n';
  return result.outcome == irk::Outcome::kSuccess && std::abs(result.state.x[0] - 5.5) < 1e-9 ? 0 : 1;
}
