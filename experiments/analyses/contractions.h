// contractions.csv: how fast the paper's Newton method contracts, iteration by iteration.
#pragma once

#include <filesystem>
#include <vector>

#include "experiments/analyses/run_file.h"
#include "experiments/study/study.h"

namespace irk {

/// c(1), c(2), ... of the residual in one solve with a kept Jacobian, paper (3.3): c(i) = eps(i) / eps(i-1).
using Contractions = std::vector<double>;

/// Repeats a run with newton 'modified' and observes every solve: it iterates with the same Jacobian and start values
/// until the residual has fallen by `residual_tolerance`, or as long as the paper's rule allows. Observing does not
/// change the run. The result has the solves of whole steps and of their halves. Throws Misuse as makeSetup.
std::vector<Contractions> observedContractions(const RunSpec& spec);

/// A sample of the solves with at least four iterations of successful runs with newton 'modified', one row each:
/// columns of a series, rtol, solve (its number in the run), iterations, and c1, c2, ... c6 (NaN where it needed
/// fewer).
void writeContractions(const Study& study, const RunFile& runs, const std::filesystem::path& file);

}  // namespace irk
