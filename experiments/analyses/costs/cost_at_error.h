// cpu_at_error.csv: the cost of each method at given errors.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "experiments/analyses/run_file.h"

namespace irk {

/// The cause for a series whose errors are unknown.
inline constexpr std::string_view kNoReference = "no reference";
/// The cause of a missing cost if errors lie below the accuracy of a computed reference: the series may reach the
/// error.
inline constexpr std::string_view kNotMeasurable = "below the reference's accuracy";

/// The cause of a missing cost if the solver cannot be applied to the scene, which is no failure.
inline constexpr std::string_view kNotApplicable = "no success: refused";

struct CostPoint {
  double error;
  double cost;
};

/// The cost at which the lower envelope of the points reaches `target`, interpolated in log-log scale. If the
/// cheapest point is more accurate already, its cost; NaN if no point reaches the target.
double costAtError(std::vector<CostPoint> points, double target);

/// The same for the successful runs of a series. `cost` names a column. An error that is not measurable counts as the
/// bound below which it lies.
double seriesCostAtError(const Table& runs, const RunSeries& series, std::string_view cost, double target);

/// Whether a row of cpu_at_error.csv says that a solver reaches an error or does not: false where the error is not
/// known or not measurable, where the solver cannot be applied, and where all its tolerances were larger than the
/// error.
bool isComparable(const Table& costs, const TableRow& row);

/// The columns of a series, then target_error, cpu_s, residuals, newton_iterations, jacobians, factorizations,
/// reached (0 if the series does not reach the error; its costs are then nan), cause (the reason: `no reference`,
/// `below the reference's accuracy`, `not accurate enough`, or `no success: ` with the outcome of the last run),
/// least_tolerance (the smallest tolerance of the series, nan for fixed steps), block.
void writeCosts(const RunFile& runs, const std::vector<double>& targets, const std::filesystem::path& file);

}  // namespace irk
