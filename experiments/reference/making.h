// Computes references: by two methods with two tolerances each, in 50 digits if possible, else in double.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "experiments/reference/compute.h"
#include "experiments/reference/question.h"

namespace irk {

struct ReferenceLimits {
  /// > 0. CPU time of four runs together: of those in 50 digits, and of each of two attempts in double.
  double cpu_s = 60;
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
  double seconds = 0;   ///< wall-clock time of the computation, with that of the references made together with it
  bool interrupted = false;
};

/// How references are made.
struct MakingWatch {
  int jobs = 1;  ///< threads, > 0
  const std::atomic<bool>* stop = nullptr;
  /// Called now and then, never by two threads at once, with what is being computed and the CPU time that it has taken.
  std::function<void(const std::string& text)> show = {};
};

/// For each question the values of all components and outputs at its t_end on which the four runs agree. The questions
/// (at least one) differ in t_end only and have ascending ones: each run is one integration through all of them. With
/// 50 digits: radau_iia_16 and lobatto_iiic_16 as in `irk reference`; in double: Radau IIA and Lobatto IIIC of variable
/// order with small steps. Switches are located; index 2. Double is used where the scene has no 50 digits or too many
/// unknowns for them, and from the time on at which the runs in 50 digits fail or take too long; runs in 50 digits that
/// disagree are not followed by others. Exceptions become `problem`.
std::vector<ComputedReference> makeReferences(const std::vector<ReferenceQuestion>& questions,
                                              const ReferenceLimits& limits, const MakingWatch& watch);

}  // namespace irk
