// Coefficients of the families rounded to double. The build writes them (tableaus/generate_constants.cpp) with the
// construction that other precisions use at run time: constructing thirteen members takes milliseconds, longer than
// many integrations.
#pragma once

#include "tableaus/families/families.h"

namespace irk {

/// The same number as `constructFamily(family, s).cast<double>()`, bit by bit, but read from a table for s up to
/// kConstantStages. Throws Misuse as constructFamily.
Tableau<double> familyInDouble(const Family& family, Index s);

/// The largest number of stages in the table.
inline constexpr Index kConstantStages = 20;

namespace detail {
/// For each family, for each s from minStages() to kConstantStages: A row by row, b, c. Written by the build.
extern const double kConstants[];
}  // namespace detail

}  // namespace irk
