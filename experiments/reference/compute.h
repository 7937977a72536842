// A task's values: four integrations, and what they agree on.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "experiments/base/progress.h"
#include "experiments/reference/tasks.h"

namespace irk {

/// A number that belongs to a scene with its settings, a time and a component or output.
struct ReferenceValue {
  std::string scene, settings;  ///< settings as `settingsText`, without defaults
  std::string t;                ///< decimal
  std::string component;
  mp50 value;
  double accuracy = 0;  ///< absolute
  std::string source;

  /// Names the place in messages: `slider_crank torque_off_at=0.5, theta at t = 1`.
  std::string place() const;
};

/// Whether they are about the same number; times compare as numbers.
bool samePlace(const ReferenceValue& a, const ReferenceValue& b);

struct ComputedTask {
  std::vector<ReferenceValue> values;  ///< by time, then in the order of components and outputs
  /// Failed runs (then there are no values), exact solutions that the integration contradicts.
  std::vector<std::string> problems;
};

/// Who watches the computation, and how it is spread over threads.
struct ReferenceWatch {
  int jobs = 1;  ///< threads, > 0
  const std::atomic<bool>* stop = nullptr;
  Progress* progress = nullptr;
};

/// Announces a task's runs.
void expectRuns(const ReferenceTask& task, Progress& progress);

/// For each task the values at its `times` (decimal, ascending, from the scene's start on).
/// Exact ones where the scene knows them, if the integrations agree with them; else what the four
/// integrations agree on. A stopped computation ends in problems.
std::vector<ComputedTask> compute(const std::vector<ReferenceTask>& tasks,
                                  const std::vector<std::vector<std::string>>& times,
                                  const ReferenceWatch& watch);

}  // namespace irk
