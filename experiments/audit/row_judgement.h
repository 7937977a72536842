// The judgement of a run of any study, from its row in runs.csv.
#pragma once

#include "experiments/audit/judge.h"
#include "experiments/tables/table.h"

namespace irk::audit {

/// Judges as judge.h says, by the errors of the row. The run has no perturbed twins: systems that multiply errors are
/// not set aside as an audit does. The tolerance is the larger one of rtol and atol; without one (constant steps) a
/// success is unjudged.
Judgement judgeRow(const Table& runs, const TableRow& row);

/// The larger one of rtol and atol; NaN for constant steps.
double toleranceOf(const Table& runs, const TableRow& row);

}  // namespace irk::audit
