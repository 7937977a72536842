// gaps.csv: the problems that one solver solves and another does not.
#pragma once

#include <filesystem>

#include "experiments/analyses/run_file.h"

namespace irk {

/// Compares the runs of runs.csv on each problem: a scene with its settings, at one tolerance. One row for each run
/// that is not right although another solver's is. Columns: scene, settings, tolerance, solver (SolverNames), judgement
/// (failed or wrong, by the audit's bar: experiments/audit/judge.h), outcome, detail, right (the solvers that are
/// right, separated by blanks). Refused runs and runs with constant steps do not count. Memory holds the judgement of
/// each run.
void writeGaps(const RunFile& runs, const std::filesystem::path& file);

}  // namespace irk
