// The four integrations of a computed reference, which end early if they would cost too much.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/reference/course.h"
#include "experiments/reference/integration.h"
#include "experiments/reference/tasks.h"

namespace irk {

using ReferenceSpecs = std::array<RunSpec, kReferenceRuns>;  // the looser ones first, the best one last

struct AttemptWatch {
  int jobs = 1;  ///< threads, > 0
  const std::atomic<bool>* stop = nullptr;
  double cpu_s = 60;  ///< > 0; CPU time of the runs together
  /// With it the runs end as soon as they can be expected to take more than `cpu_s`.
  Course course = {};
  /// Called now and then, never by two threads at once, with the part of the whole cost that is spent: 0 to 1, NaN if
  /// the course is unknown.
  std::function<void(double part)> progress = {};
};

struct Attempted {
  std::array<Integrated, kReferenceRuns> runs;
  std::string failure;  ///< of the first run that failed, which ends the others where it has ended; empty: none
};

/// Integrates all specs to each of the times (decimal, ascending).
Attempted attempt(const ReferenceSpecs& specs, const std::vector<std::string>& times, const AttemptWatch& watch);

/// What the runs of an attempt cost, while they are made. Not thread-safe.
class AttemptCosts {
 public:
  AttemptCosts(double limit, Course course) : limit_(limit), course_(std::move(course)) {}

  /// A run has come to t and has taken these seconds. Why all runs must end now, in one line; empty: they need not.
  std::string reached(std::size_t run, double t, double cpu_s);
  /// The CPU seconds that all runs will have taken; NaN if that is not known yet.
  double expected() const;
  double spent() const;

 private:
  struct Run {
    double cpu_s = 0, part = 0;
  };
  double limit_;
  Course course_;
  std::array<Run, kReferenceRuns> runs_;
};

}  // namespace irk
