// What each solver needs for each problem, from cpu_at_error.csv.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "experiments/tables/table.h"

namespace irk {

/// Solver -> problem that it was given -> cost > 0; infinity where it does not reach the error.
using SolverCosts = std::map<std::string, std::map<std::string, double>>;

/// Adds the CPU time in a row of cpu_at_error.csv, for the solver that the column `solver` names. A problem is a scene
/// with its settings, its end and an error; the cheapest of several rows of a solver counts. Rows that are not
/// comparable (isComparable) are left out.
void addCost(const Table& costs, const TableRow& row, std::string_view solver, SolverCosts& found);

/// The least cost of each problem that some solver solves.
std::map<std::string, double> leastCosts(const SolverCosts& costs);

}  // namespace irk
