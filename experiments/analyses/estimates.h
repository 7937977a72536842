// estimates.csv: the estimated and the true error of single steps.
#pragma once

#include <filesystem>

#include "experiments/analyses/run_file.h"
#include "experiments/study/study.h"

namespace irk {

/// Takes single steps from points on the solutions of the study's successful runs with step doubling: one step h and
/// two steps h/2 as in the run, and a much more accurate solution over the same interval. The stage equations are
/// solved to round-off, so that only the estimate is tested.
///
/// Columns: those of a series, rtol, t, h, group (u, v, x, z), difference (between the two solutions), error (of the
/// two half steps), doubling and richardson (true error divided by each estimate). Values are the largest of the
/// group, in units of the scene's scales; rows at round-off are left out.
void writeEstimates(const Study& study, const RunFile& runs, const std::filesystem::path& file);

}  // namespace irk
