// cpu_at_error.csv: what each method costs at given errors.
#pragma once

#include <string_view>
#include <vector>

#include "experiments/runs/run_table.h"

namespace irk {

/// The cause of a cost that is unknown since no error is known.
inline constexpr std::string_view kNoReference = "no reference";

struct CostPoint {
  double error;
  double cost;
};

/// The cost at which the lower envelope of the points reaches `target`, interpolated in log-log;
/// the cheapest cost if that is more accurate already; NaN if no point reaches it.
double costAtError(std::vector<CostPoint> points, double target);

/// The same for the successful runs of a series: `cost` is a column, the errors are `error`.
double seriesCostAtError(const Table& runs, const RunSeries& series, std::string_view cost,
                         double target);

/// The columns of a series, then target_error, cpu_s, residuals, newton_iterations, jacobians,
/// factorizations, reached (0 with nan where a series does not get there), cause (why not: `no
/// reference`, `not accurate enough`, or `no success: ` with the outcome of the last run), block.
Table costTable(const Table& runs, const std::vector<double>& targets);

}  // namespace irk
