// The runs of an ensemble: one spec over a grid of parameters and starts.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "experiments/ensembles/grid.h"
#include "experiments/runs/run.h"

namespace irk {

/// The members of an ensemble. Immutable: threads may share it.
class Ensemble {
 public:
  /// `spec.t_end`: NaN for the end of each member's own scene. Throws Misuse for what no member can have: values that
  /// are out of range, unknown parameters and components of the start, combinations of options that do not work,
  /// references and threads.
  Ensemble(RunSpec spec, Grid grid);

  const Grid& grid() const { return grid_; }
  /// Of the components u, v, x, z.
  const std::vector<std::string>& names() const { return names_; }

  /// The spec of member i, and the components of its start that are not those of its scene.
  RunSpec spec(std::size_t i) const;
  Settings start(std::size_t i) const;

 private:
  void requireValues() const;

  RunSpec spec_;
  Grid grid_;
  std::vector<std::string> names_;
};

/// Receives the record of member i.
using MemberDone = std::function<void(std::size_t i, const RunRecord& record)>;

/// Makes the runs of all members on `jobs` threads and calls `done` with each, one at a time, in the order in which
/// they end. A member that throws has the outcome `refused` or `exception` (asRow). Members that differ in their starts
/// only share what a thread has prepared for them. The results do not depend on the number of threads. Members that are
/// not begun when `stop` is set have no record. Returns the CPU time of all threads in seconds.
double runEnsemble(const Ensemble& ensemble, int jobs, const std::atomic<bool>& stop, const MemberDone& done);

}  // namespace irk
