// phases.csv: the share of each part of an integration in its time.
#pragma once

#include <iosfwd>
#include <string>

#include "experiments/analyses/run_file.h"
#include "experiments/study/study.h"

namespace irk {

/// For every successful run of the study: the time of each part, measured alone and serially, multiplied by the run's
/// counter; and the time of the whole run, measured next to its parts. Columns: those of a series, rtol, n;
/// residual_s, jacobian_s, factorization_s, solve_s, filter_factorization_s, filter_solve_s, update_s, step_s, start_s
/// (time of a single one: r at one stage; the rest of an iteration; the rest of an attempted step; the start of an
/// integration with its search for a pattern); share_residual, ... share_start (shares of their sum); run_s (the whole
/// run); covered (their sum divided by run_s). Studies with variable order are refused.
Table phaseTable(const Study& study, const RunFile& runs, std::ostream& progress);

/// How many rows have parts that cover less than 0.9 or more than 1.1 of the whole run, as on a busy machine: their
/// shares are unreliable. Empty if none has.
std::string doubtfulShares(const Table& phases);

}  // namespace irk
