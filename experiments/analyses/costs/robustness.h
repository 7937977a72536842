// robustness.csv: how runs end, by collection, solver and tolerance.
#pragma once

#include <filesystem>
#include <set>
#include <string>

#include "experiments/analyses/run_file.h"
#include "experiments/tables/table.h"

namespace irk {

/// What a solver is called in tables of all runs of a study: its integrator, and where a study runs it in several
/// formulations of the constraints, `integrator:formulation`. Reads the runs once. `runs` must outlive it.
class SolverNames {
 public:
  explicit SolverNames(const RunFile& runs);
  std::string of(const TableRow& row) const;

 private:
  const Table& names_;
  std::set<std::string> several_;  // integrators with more than one formulation
};

/// Counts the runs of runs.csv: one row per collection (`all` for all scenes), solver and tolerance (`all` for all
/// of them), in this order. Columns: collection, integrator, tolerance, runs, right, failed, wrong, unjudged, outcomes
/// (of the failed ones: `timeout 2; newton_failed 1`). The bar of a wrong success is that of the audit
/// (experiments/audit/judge.h). A run that is refused because the solver cannot be applied to the scene does not count,
/// nor does one with constant steps.
void writeRobustness(const RunFile& runs, const std::filesystem::path& file);

}  // namespace irk
