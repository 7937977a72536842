// What evaluations of claims share: choosing rows, medians, costs of two variants at equal errors.
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/base/median.h"
#include "experiments/claims/claims.h"
#include "experiments/runs/run_table.h"

namespace irk::claims {

/// Column and cell.
using Cells = std::vector<std::pair<std::string_view, std::string_view>>;

/// The rows with these cells.
Table where(const Table& table, const Cells& cells);
using Blocks = std::vector<std::string_view>;
/// The rows of a built-in study's table that are of one of these blocks. Throws Misuse for a table without the column
/// of blocks, std::logic_error for a block that the study does not have.
Table inBlocks(const Table& table, std::string_view study, const Blocks& blocks);
/// The rows that the test accepts.
Table where(const Table& table, const std::function<bool(const TableRow&)>& test);
/// Different cells, in order of appearance.
std::vector<std::string> distinct(const Table& table, std::string_view column);
/// The numbers of a column, NaN left out.
std::vector<double> numbersOf(const Table& table, std::string_view column);

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// The least `cpu_s` of the rows that the test accepts; infinity of none.
double leastCost(const Table& table, const std::function<bool(const TableRow&)>& test);

/// The part of the values that the test accepts; NaN of nothing.
double part(const std::vector<double>& values, const std::function<bool(double)>& test);
/// `0.5 %`.
std::string percent(double part);

/// Costs of `other` over those of `base` at equal errors.
struct CostRatios {
  std::vector<double> all;  ///< one per pair of series and error that both reach
  int lost = 0;             ///< errors that only `base` reaches
  int won = 0;              ///< errors that only `other` reaches
};
/// Pairs of series that are equal but for one column, compared at the errors 1e-2, 1e-3, ... 1e-10.
CostRatios compareCosts(const Table& runs, std::string_view column, std::string_view base, std::string_view other,
                        std::string_view cost);

/// The errors at which costs are compared.
std::span<const double> comparedErrors();

/// Of two thresholds: `good` and better, `fair` and better, else contradicted. Smaller is better.
Verdict graded(double value, double good, double fair);
Finding notMeasurable(std::string reason);

}  // namespace irk::claims
