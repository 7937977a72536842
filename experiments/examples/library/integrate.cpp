/// @example integrate.cpp
/// One integration of a pendulum with a constraint: its state, the solution inside of steps, counters, a failure.
#include <irk/dependent_constraints.h>
#include <irk/ggl.h>
#include <irk/integrator.h>
#include <irk/misuse.h>
#include <irk/monitor.h>
#include <irk/options.h>
#include <irk/outcome.h>
#include <irk/problem.h>
#include <irk/problem_system.h>
#include <irk/scalar.h>
#include <irk/statistics.h>
#include <irk/system.h>
#include <irk/system_options.h>
#include <irk/tableau.h>
#include <irk/tableaus.h>

#include <cmath>
#include <iostream>

namespace {

// A mass on a massless rod: M u'' = f - G^T lambda, 0 = g(u).
struct Pendulum {
  double m = 1, l = 1, g = 9.81;
  irk::Sizes sizes() const { return {.nu = 2, .nz = 1, .constraints = 1}; }
  template <class T>
  void residual(const irk::Point<T>& p, irk::Rows<T> r) const {
    r.u[0] = -m * p.a[0] - p.u[0] * p.z[0];
    r.u[1] = -m * p.a[1] - m * g - p.u[1] * p.z[0];
  }
  template <class T, class U, class G>
  void constraints(const T&, const U& u, G&& c) const {
    c[0] = (u[0] * u[0] + u[1] * u[1] - l * l) * 0.5;
  }
};

// The length of the rod after 10 s, with the constraint as the formulation says.
double lengthAfter(irk::Formulation formulation) {
  irk::State<double> start(Pendulum{}.sizes());
  start.u << 1, 0;
  // A second rod between the same points would follow from the first one: it would be found here, and left out.
  const auto left_out = irk::dependentConstraints(*irk::makeSystem<double>(Pendulum{}), start);
  const auto system = irk::makeSystem<double>(Pendulum{}, {.formulation = formulation, .left_out = left_out});
  irk::IntegratorOptions options;
  options.tolerances = {.rtol = 1e-6, .atol = 1e-6};
  const irk::Tableau<double> method = irk::makeTableau<double>("radau_iia_3");
  irk::Integrator<double> integrator(system, method, options);

  irk::Index crossings = 0;  // of the lowest point, found inside of the steps
  double last = 1;
  irk::Monitor<double> monitor;
  monitor.inside = true;
  monitor.accepted = [&](const irk::StepRecord<double>& step) {
    const double middle = step.inside->at(step.t - step.h / 2).u[0], end = step.state.u[0];
    crossings += (last * middle < 0) + (middle * end < 0);
    last = end;
  };
  const irk::Solution<double> solution = integrator.integrate(start, 10.0, monitor);
  std::cout << name(solution.outcome) << ": " << crossings << " crossings in " << solution.counters.steps_accepted
            << " steps\n";
  return solution.outcome == irk::Outcome::kSuccess ? solution.state.u.norm() : std::nan("");
}

}  // namespace

int main() {
  // In index 2 positions drift; GGL keeps them on the constraint.
  const double index2 = lengthAfter(irk::Formulation::kIndex2), ggl = lengthAfter(irk::Formulation::kGgl);
  std::cout << "length - 1: " << index2 - 1 << " in index 2, " << ggl - 1 << " with GGL\n";
  try {
    (void)irk::makeTableau<double>("radau_iia_0");
    return 1;
  } catch (const irk::Misuse& misuse) {  // names what is allowed
    std::cout << misuse.what() << '\n';
  }
  return std::abs(index2 - 1) < 1e-2 && std::abs(ggl - 1) < 1e-8 ? 0 : 1;
}
