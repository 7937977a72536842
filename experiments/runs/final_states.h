// The final states of a study's runs: states.csv.
#pragma once

#include <string>

#include "experiments/runs/run.h"

namespace irk {

/// The components u, v, x, z of a scene, one after the other.
Vec<double> componentsOf(const RunRecord& record);

/// Their error bars in the same order, absolute; NaN: unknown. Empty: none was measured, or it is unknown as a whole.
Vec<double> barsOf(const RunRecord& record);

/// Numbers as text, separated by blanks; `parseVector` reads it back.
std::string vectorText(const Vec<double>& y);
Vec<double> parseVector(const std::string& text);

}  // namespace irk
