// phases.csv: what the parts of an integration take of its time.
#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include "experiments/study/study.h"
#include "experiments/tables/table.h"

namespace irk {

/// For every successful run of the study: the time of each part, measured alone and serially, times
/// the run's counters; and the time of the whole run, measured next to its parts. Columns: those of a
/// series, rtol, n; residual_s, jacobian_s, factorization_s, solve_s, update_s, step_s, start_s (one
/// each: r at one stage; the rest of an iteration, of an attempted step, the start of an integration with its search for a pattern);
/// share_residual, ... share_start (of their sum); run_s (the whole run); covered (their sum over
/// run_s). Variable order has no rows: studies with it are refused.
Table phaseTable(const Study& study, const Table& runs, std::ostream& progress);

/// One line for each row whose parts do not cover 0.9 to 1.1 of the whole run. Such shares are wrong.
std::vector<std::string> uncoveredRuns(const Table& phases);

/// Seconds of one call: the mean over a batch so long that reading the clock takes less than 1 % of it.
double batchSeconds(const std::function<void()>& call);

}  // namespace irk
