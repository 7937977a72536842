// Computes the reference values of a task from four integrations.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "experiments/base/progress.h"
#include "experiments/reference/tasks.h"

namespace irk {

/// A value of one component or output, for a scene with its settings and a time.
struct ReferenceValue {
  std::string scene, settings;  ///< settings as `settingsText`, without defaults
  std::string t;                ///< decimal
  std::string component;
  BigFloat value;
  double accuracy = 0;  ///< absolute
  std::string source;

  /// The value's place for messages: `slider_crank torque_off_at=0.5, theta at t = 1`.
  std::string place() const;
};

/// Whether both are about the same number; times are compared by value.
bool samePlace(const ReferenceValue& a, const ReferenceValue& b);

struct ComputedTask {
  std::vector<ReferenceValue> values;  ///< by time, then in the order of components and outputs
  /// A failed run (then there are no values), and exact solutions that the integrations contradict.
  std::vector<std::string> problems;
};

/// Progress, threads and stop flag of a computation.
struct ReferenceWatch {
  int jobs = 1;  ///< threads, > 0
  const std::atomic<bool>* stop = nullptr;
  Progress* progress = nullptr;
};

/// Announces a task to `progress`.
void expectTask(const ReferenceTask& task, Progress& progress);

/// The values at these times (decimal, ascending, from the scene's start on). A value is exact if the scene has a
/// closed form with which the integrations agree; otherwise it has the digits on which the four integrations agree. A
/// computation that is stopped reports problems.
ComputedTask compute(const ReferenceTask& task, const std::vector<std::string>& times, const ReferenceWatch& watch);

}  // namespace irk
