// Runs a scene and records its switches.
#pragma once

#include <string>
#include <vector>

#include "irk/integrator.h"
#include "irk/tableaus.h"
#include "tests/problems/scene_cases.h"

namespace irk::test {

inline constexpr double kTolerance = 1e-10;

struct Event {
  std::string name;
  double t;
};

struct Result {
  Solution<double> solution;
  std::vector<Event> events;
};

inline Result run(const SceneCase& c, double t_end, Discontinuity mode, double tolerance = kTolerance,
                  const char* method = "radau_iia_5") {
  const auto tableau = makeTableau<double>(method);
  const auto scene = makeScene<double>(c.id, c.settings);
  IntegratorOptions options;
  options.tolerances.rtol = options.tolerances.atol = tolerance;
  Integrator<double> integrator(scene.system({.discontinuity = mode}), tableau, options, scene.scale);
  Result r;
  Monitor<double> monitor;
  monitor.switched = [&](const SwitchRecord<double>& s) { r.events.push_back({s.name, s.t}); };
  r.solution = integrator.integrate(scene.start, t_end, monitor);
  return r;
}

}  // namespace irk::test
