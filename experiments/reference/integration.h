// One integration that returns the states at given times.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "experiments/runs/run_spec.h"
#include "irk/multiprecision.h"

namespace irk {

/// CPU seconds that several integrations share. Thread-safe.
class CpuBudget {
 public:
  explicit CpuBudget(double limit) : limit_(limit) {}
  void spend(double seconds) { spent_ += seconds; }
  /// Whether less than `more` seconds are left.
  bool exceededBy(double more) const { return spent_ + more > limit_; }
  double limit() const { return limit_; }

 private:
  double limit_;
  std::atomic<double> spent_ = 0;
};

/// A stop flag and a budget, which may end an integration before its last time. Both are optional.
struct IntegrationWatch {
  const std::atomic<bool>* stop = nullptr;
  CpuBudget* budget = nullptr;
};

struct Integrated {
  std::vector<std::vector<mp50>> rows;  ///< for each time the components and then the outputs of the scene
  std::string failure;                  ///< why there are no rows, in one line; empty: none
};

/// The components u, v, x, z of the state, then the outputs of the scene.
template <class Real>
std::vector<mp50> componentsAndOutputs(const Scene<Real>& scene, const State<Real>& state);

/// Integrates the spec, in its scalar (double or mp50), to each of the times: decimal, ascending, from the scene's
/// start on. Exceptions become failures. The budget is looked at before each step.
Integrated integrated(const RunSpec& spec, const std::vector<std::string>& times, const IntegrationWatch& watch);

}  // namespace irk
