// The answers of studies that do not measure the cost of an error.
#pragma once

#include <string>

#include "experiments/tables/table.h"

namespace irk::report {

/// small_steps, of runs.csv: the multiplier's error and the Jacobians per step at the smallest step that all
/// formulations have.
std::string smallStepsSentence(const Table& runs);

/// estimate, of estimates.csv: in how many steps the true error is larger than the estimate by step doubling.
std::string estimateSentence(const Table& estimates);

/// scaling, of scaling_slopes.csv: the powers of n with which the time of a step grows.
std::string scalingSentence(const Table& slopes);

/// The studies of failures, of runs.csv: the families that fail most and least often.
std::string familiesFailSentence(const Table& runs);

/// phases, of phases.csv: the part with the largest share of the time, at the smallest and the largest n.
std::string phasesSentence(const Table& phases);

/// round_off, of energy.csv: the largest error of the energy by summation.
std::string energySentence(const Table& energy);

/// steps, of runs.csv: how many steps the methods take, and how many tries are rejected.
std::string stepsSentence(const Table& runs);

}  // namespace irk::report
