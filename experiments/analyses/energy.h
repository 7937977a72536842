// energy.csv: what round-off does to a conserved energy over many steps.
#pragma once

#include <vector>

#include "experiments/study/study.h"
#include "experiments/tables/table.h"

namespace irk {

/// Deviations of an energy from a straight line over time.
struct EnergyDrift {
  double drift = 0;    ///< slope, per unit of time
  double scatter = 0;  ///< RMS distance from the line
  double largest = 0;  ///< |error|
};
/// Least squares through (t_i, error_i); NaN of fewer than three points.
EnergyDrift energyDrift(const std::vector<double>& t, const std::vector<double>& error);

/// For every run of the study with fixed steps that succeeded, on a scene with the output "energy":
/// the run again, the error of the energy (in the scene's unit) after every k-th step, k such that about 2000 are
/// seen. The energy is computed in 50 digits from u + carry, v + carry: the evaluation adds no
/// round-off of its own. Columns: those of a series, h, t, energy_error, drift, scatter,
/// largest (the last three of the whole run).
Table energyTable(const Study& study, const Table& runs);

}  // namespace irk
