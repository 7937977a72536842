// One integration that returns the states at given times.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "experiments/runs/run_spec.h"
#include "irk/multiprecision.h"

namespace irk {

/// What may end an integration before its last time. Both are optional.
struct IntegrationWatch {
  const std::atomic<bool>* stop = nullptr;
  /// Called before each step with the time reached and the CPU seconds of this integration: a text, one line, ends it
  /// as the reason.
  std::function<std::string(double t, double cpu_s)> refuse = {};
};

struct Integrated {
  std::vector<std::vector<BigFloat>> rows;  ///< for each time reached the components and then the outputs of the scene
  std::string failure;                      ///< why there are not all rows, in one line; empty: there are
};

/// The components u, v, x, z of the state, then the outputs of the scene.
template <class Real>
std::vector<BigFloat> componentsAndOutputs(const Scene<Real>& scene, const State<Real>& state);

/// Integrates the spec, in its scalar, to each of the times: decimal, ascending, from the scene's
/// start on. Exceptions become failures.
Integrated integrated(const RunSpec& spec, const std::vector<std::string>& times, const IntegrationWatch& watch);

}  // namespace irk
