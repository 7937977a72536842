// cpu_at_error.csv: what each method costs at given errors.
#pragma once

#include <vector>

#include "experiments/table.h"

namespace irk {

struct CostPoint {
  double error;
  double cost;
};

/// The cost at which the lower envelope of the points reaches `target`, interpolated in log-log;
/// the cheapest cost if that is more accurate already; NaN if no point reaches it.
double costAtError(std::vector<CostPoint> points, double target);

/// Columns scene, settings, family, stages, target_error, cpu_s, residuals, newton_iterations,
/// reached (0 with nan where a method does not get there).
Table costTable(const Table& runs, const std::vector<double>& targets);

}  // namespace irk
