// Computes the reference of one question: by two methods with two tolerances each, in 50 digits if possible, else in
// double.
#pragma once

#include <atomic>
#include <string>
#include <vector>

#include "experiments/reference/compute.h"
#include "experiments/reference/question.h"

namespace irk {

struct ReferenceLimits {
  double cpu_s = 120;  ///< > 0; CPU time of the four runs in 50 digits together, and again of those in double
  /// Above this many unknowns the four runs are made in double only: one factorization in 50 digits takes minutes, and
  /// the CPU time is looked at between steps only.
  Index most_unknowns = 100;
  /// Runs that differ by more than this, measured as an error, disagree.
  double disagreement = 1e-6;
};

struct ComputedReference {
  std::vector<ReferenceValue> values;  ///< at t_end; empty: there is no reference
  std::string problem;                 ///< why there are no values, in one line
  /// Why the values are not those of 50 digits, in one line; empty if they are.
  std::string in_double;
  double accuracy = 0;  ///< of all values, measured as an error
  double seconds = 0;   ///< wall-clock time of the computation
  bool interrupted = false;
};

/// The values of all components and outputs at t_end on which the four runs agree. With 50 digits: radau_iia_16 and
/// lobatto_iiic_16 as in `irk reference`; in double: radau_iia_7 and lobatto_iiic_6 with small steps. Switches are
/// located; index 2. Double is used where the scene has no 50 digits or too many unknowns for them, and where the runs
/// in 50 digits fail or take too long; runs in 50 digits that disagree are not followed by others. `jobs` threads.
/// Exceptions become `problem`.
ComputedReference makeReference(const ReferenceQuestion& question, const ReferenceLimits& limits, int jobs,
                                const std::atomic<bool>* stop);

}  // namespace irk
