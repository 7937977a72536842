// Runs with switches, for the tests of core.
#pragma once

#include <vector>

#include "tests/core/support.h"

namespace irk::test {

struct Event {
  double t;
  Index index;
};

struct Result {
  Solution<double> solution;
  std::vector<Event> events;
};

template <class P>
Result run(const P& problem, const State<double>& start, double t_end, Discontinuity mode,
           const IntegratorOptions& options, const char* method = "radau_iia_3") {
  Integrator<double> integrator(makeSystem<double>(problem, {Formulation::kIndex2, ConstraintScaling::kOn, mode}),
                                makeTableau<double>(method), options);
  std::vector<Event> events;
  Monitor<double> monitor;
  monitor.switched = [&](const SwitchRecord<double>& s) { events.push_back({s.t, s.index}); };
  return {integrator.integrate(start, t_end, monitor), events};
}

}  // namespace irk::test
