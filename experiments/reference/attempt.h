// The four integrations of a computed reference, and the numbers on which they agree.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "experiments/reference/agreement.h"
#include "experiments/reference/integration.h"
#include "experiments/reference/tasks.h"

namespace irk {

using ReferenceSpecs = std::array<RunSpec, kReferenceRuns>;  // the looser ones first, the best one last

struct AttemptWatch {
  int jobs = 1;  ///< threads, > 0
  const std::atomic<bool>* stop = nullptr;
  /// CPU time of the runs together, after which they end: > 0.
  double cpu_s = std::numeric_limits<double>::infinity();
  /// Called now and then, never by two threads at once, with the CPU seconds that are spent.
  std::function<void(double cpu_s)> progress = {};
};

struct Attempted {
  std::array<Integrated, kReferenceRuns> runs;
  std::string failure;  ///< of the first run that failed, which ends the others where it has ended; empty: none

  /// Whether all runs have come to the time with this number.
  bool hasReached(std::size_t time) const;
};

/// Integrates all specs to each of the times (decimal, ascending).
Attempted attempt(const ReferenceSpecs& specs, const std::vector<std::string>& times, const AttemptWatch& watch);

struct AgreedNumber : AgreedValue {
  double size;  ///< the magnitude of the value or its scale, whichever is larger
};

/// What the runs agree on for one component or output at a time that all have reached; nullopt where it is not finite.
/// Differences below `least` times its size are round-off.
std::optional<AgreedNumber> agreedNumber(const Attempted& made, std::size_t time, std::size_t number, double least,
                                         double scale);

}  // namespace irk
