// Which solver should I use? From the costs and outcomes of the study work_precision.
#pragma once

#include <functional>
#include <string_view>

#include "experiments/claims/result_tables.h"
#include "experiments/report/answers/answer.h"
#include "experiments/report/answers/ranking.h"

namespace irk::report {

/// By collection, the first word of a block's name (`ivp_variable`), and error: the fastest solver (ranking.h),
/// its factor over the next one and over the best of other libraries, and how many of its runs fail or are wrong: end
/// as success with an error in u, v or x above the audit's bar, 1000 tolerance + 1e-9.
Answer solverAnswer(const claims::ResultTables& tables);

/// The costs (addCost) of the rows of cpu_at_error.csv that `choose` accepts, by the solver that the column `solver`
/// names.
SolverCosts costsOf(const Table& costs, std::string_view solver, const std::function<bool(const TableRow&)>& choose);

}  // namespace irk::report
