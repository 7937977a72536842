// Compares two tables of runs and separates changes from noise.
#pragma once

#include "experiments/compare/comparison.h"

namespace irk::compare {

/// Matches runs by all fields of a spec that both tables have, not by their keys, which also contain the program's
/// version. Compares outcomes, counters, errors, and the times of runs that succeeded in both. Errors are different
/// if their ratio exceeds `errors`; errors below round-off (1.1e-14 in double) count as equal. Times are different if
/// the interval of their ratio lies outside 1 +- times; with fewer than five repetitions, which cannot be tested, if
/// their minima differ by a factor above 2. Times of different processors are not compared. Reads row by row: memory
/// does not grow with the tables (Matching). Throws Misuse for a table without outcomes, and what readTable throws.
Comparison compareRuns(const Runs& first, const Runs& second, const Limits& limits);

}  // namespace irk::compare
