// Shared by the tests of mechanisms: runs with what is recorded at each step.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "irk/integrator.h"
#include "irk/tableaus.h"
#include "tests/problems/scene_cases.h"

namespace irk::test {

/// The integration to t_end, with radau_iia of `stages`.
template <class Real>
Solution<Real> integrated(const Scene<Real>& scene, const Real& t_end, double tolerance, int stages,
                          Formulation formulation, const Monitor<Real>& monitor) {
  IntegratorOptions options;
  options.tolerances.rtol = options.tolerances.atol = tolerance;
  options.newton.max_iterations = 100;
  const auto tableau = makeTableau<Real>("radau_iia_" + std::to_string(stages));
  const auto system = scene.system({formulation});
  Vec<double> scale = Vec<double>::Ones(system->sizes().components());  // mu of GGL is behind those of the scene
  scale.head(scene.scale.size()) = scene.scale;
  Integrator<Real> integrator(system, tableau, options, scale);
  return integrator.integrate(scene.start, t_end, monitor);
}

/// The state at t_end, which is reached.
template <class Real>
State<Real> stateAfter(const Scene<Real>& scene, const Real& t_end, double tolerance, int stages,
                       Formulation formulation = Formulation::kIndex2, const Monitor<Real>& monitor = {}) {
  const auto solution = integrated(scene, t_end, tolerance, stages, formulation, monitor);
  EXPECT_EQ(solution.outcome, Outcome::kSuccess) << solution.detail;
  return solution.state;
}

/// How a run ended, the largest violation of the position constraints and of their first derivatives over it, and the
/// largest change of each output that is invariant.
struct Drift {
  Outcome outcome = Outcome::kSuccess;
  double position = 0, velocity = 0;
  std::map<std::string, double> invariants;
};

inline Drift driftOf(const Scene<double>& scene, double tolerance, Formulation formulation) {
  const auto system = scene.system({Formulation::kIndex3});
  const Sizes n = system->sizes();
  Drift drift;
  Monitor<double> monitor;
  monitor.accepted = [&](const StepRecord<double>& step) {
    const auto violation = [&](Level level) {
      const auto r = residualAt<double, double>(*system, level, step.t, pointVector(step.state), step.state.d);
      return r.segment(n.nu + n.nx, n.constraints).template lpNorm<Eigen::Infinity>();
    };
    if (n.constraints > 0) {
      drift.position = std::max(drift.position, violation(Level::kPosition));
      drift.velocity = std::max(drift.velocity, violation(Level::kVelocity));
    }
    for (const auto& output : scene.outputs) {
      if (!output.invariant) continue;
      double& largest = drift.invariants[output.name];
      largest = std::max(largest, std::abs(output.value(step.state) - output.value(scene.start)));
    }
  };
  drift.outcome = integrated<double>(scene, scene.t_end, tolerance, 5, formulation, monitor).outcome;
  return drift;
}

}  // namespace irk::test
