// Which solver is the fastest on a set of problems.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/analyses/costs/solver_costs.h"

namespace irk::report {

struct Ranked {
  std::string solver = {};
  int solved = 0, given = 0;  ///< of the problems that some solver solves
  double factor = 0;          ///< geometric mean of its cost over the least cost, of the problems that it solves
};

/// The solvers that solve something: those that solve the most problems first, among equals the cheapest first.
std::vector<Ranked> ranking(const SolverCosts& costs);

/// The number of problems that some solver solves.
int solvable(const SolverCosts& costs);

/// The geometric mean of the cost of `slow` over that of `fast`, of the problems that both solve; NaN if these are
/// fewer than half of the problems that some solver solves.
double ratio(const SolverCosts& costs, const std::string& slow, const std::string& fast);

/// In how many problems each solver is the cheapest, ties counted for all of them.
std::map<std::string, int> wins(const SolverCosts& costs);

/// `1.8 times as fast as x`, where `factor` is the cost of `other` over that of `best`, NaN if too few problems give
/// one; adds what `other` does not solve of `problems`. Without a name in `other`: that no other solver reaches the
/// error.
std::string comparison(double factor, const Ranked& best, const Ranked& other, int problems);

}  // namespace irk::report
