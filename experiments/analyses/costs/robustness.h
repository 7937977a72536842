// robustness.csv: how runs end, by collection, solver and tolerance.
#pragma once

#include <filesystem>

#include "experiments/analyses/run_file.h"

namespace irk {

/// Counts the runs of runs.csv: one row per collection (`all` for all scenes), integrator and tolerance (`all` for all
/// of them), in this order. Columns: collection, integrator, tolerance, runs, right, failed, wrong, unjudged, outcomes
/// (of the failed ones: `timeout 2; newton_failed 1`). The bar of a wrong success is that of the audit
/// (experiments/audit/judge.h). A run that is refused because the solver cannot be applied to the scene does not count,
/// nor does one with constant steps.
void writeRobustness(const RunFile& runs, const std::filesystem::path& file);

}  // namespace irk
