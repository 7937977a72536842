// The judgement of a run of any study, from its row in runs.csv.
#pragma once

#include "experiments/audit/judge.h"
#include "experiments/tables/table.h"

namespace irk::audit {

/// Judges a run as judge.h says, from the errors in its row. No perturbed starts are integrated, so that systems that
/// multiply errors are not set aside as in an audit. The tolerance is the larger one of rtol and atol; a success
/// without one (constant steps) is unjudged.
Judgement judgeRow(const Table& runs, const TableRow& row);

/// The larger one of rtol and atol; NaN for constant steps.
double toleranceOf(const Table& runs, const TableRow& row);

}  // namespace irk::audit
