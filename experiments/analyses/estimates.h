// estimates.csv: what the error estimate of a step says, beside the error that the step has.
#pragma once

#include "experiments/study/study.h"
#include "experiments/tables/table.h"

namespace irk {

/// Single steps from points of the solutions of the study's successful runs with step doubling: one
/// step h and two steps h/2 as the run took them, and a far more accurate solution of the same
/// interval. Stages are solved to round-off, so that the estimate alone is judged.
///
/// Columns: those of a series, rtol, t, h, group (u, v, x, z), difference (of the two solutions),
/// error (of the two half steps), doubling and richardson: the true error over the estimate. Values
/// are the largest of the group, in units of the scene's scales; rows at round-off are left out.
Table estimateTable(const Study& study, const Table& runs);

}  // namespace irk
