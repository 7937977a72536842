// phases.csv: what the parts of Newton's method take of a run's time.
#pragma once

#include <iosfwd>

#include "experiments/study.h"
#include "experiments/table.h"

namespace irk {

/// For every successful run of the study: the time of one residual, one Jacobian, one factorization
/// and one solve, measured alone and serially, times the run's counters. Columns: those of a
/// series, rtol, n, residual_s, jacobian_s, factorization_s, solve_s (one each), share_residual,
/// share_jacobian, share_factorization, share_solve (of their sum), covered (their sum over the
/// run's CPU time).
Table phaseTable(const Study& study, const Table& runs, std::ostream& progress);

}  // namespace irk
