// Integrates a scene over a grid of parameters and starts: in lanes, or as a loop of single runs.
#pragma once

#include <atomic>
#include <functional>
#include <optional>

#include "experiments/ensembles/grid.h"
#include "experiments/runs/run_spec.h"
#include "irk/ensemble.h"
#include "irk/scene.h"

namespace irk {

/// Members of an ensemble, made from a spec and a grid. Immutable: threads may share it. Throws Misuse for what no
/// member can have: unknown parameters and components, peers, other scalars than double, time limits and references.
class EnsembleScene {
 public:
  /// `t_end`: NaN for the end of each member's own scene.
  EnsembleScene(const RunSpec& spec, Grid grid, double t_end);

  const Grid& grid() const { return grid_; }
  /// Of the components u, v, x, z.
  const std::vector<std::string>& names() const { return first_.names; }

  /// Member i, as a single run has it.
  EnsembleMember member(std::size_t i) const;
  /// For LaneIntegrator. Throws Misuse for a scene that lanes cannot integrate; refers to this object.
  Ensemble lanes() const;

 private:
  Settings settingsOf(std::size_t i) const;
  std::vector<Settings> everyValue() const;
  Scene<double> sceneOf(std::size_t i) const;
  void setStart(std::size_t i, State<double>& start) const;

  RunSpec spec_;
  const SceneEntry& entry_;
  SystemOptions system_options_;
  Grid grid_;
  double t_end_;
  Scene<double> first_;
  std::shared_ptr<const System<double>> system_;  // of all members, if they differ in their starts only
  std::vector<Index> start_components_;           // of (u, v, x)
};

struct EnsembleOptions {
  bool lanes = true;  ///< false: a loop of single runs with the same options
  int jobs = 1;       ///< threads
  const std::atomic<bool>* stop = nullptr;
};

/// Integrates all members and calls `done` with each result, one at a time, in the order in which they end. The results
/// do not depend on the number of threads. Members that are not begun when `stop` is set have no result. Returns the
/// CPU time of all threads in seconds.
double runEnsemble(const EnsembleScene& scene, const RunSpec& spec, const EnsembleOptions& options,
                   const LaneIntegrator::Done& done);

}  // namespace irk
