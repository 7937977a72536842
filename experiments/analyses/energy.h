// energy.csv: the effect of round-off on a conserved energy over many steps.
#pragma once

#include <filesystem>
#include <vector>

#include "experiments/analyses/run_file.h"
#include "experiments/study/study.h"

namespace irk {

/// Deviations of an energy from a straight line over time.
struct EnergyDrift {
  double drift = 0;    ///< slope, per unit of time
  double scatter = 0;  ///< RMS distance from the line
  double largest = 0;  ///< |error|
};
/// Least squares through (t_i, error_i); NaN for fewer than three points.
EnergyDrift energyDrift(const std::vector<double>& t, const std::vector<double>& error);

/// Repeats every successful run of the study that has fixed steps and a scene with the output "energy", and records
/// the error of the energy (in the scene's unit) after every k-th step, with k such that about 2000 values are
/// recorded. The energy is computed in 50 digits from u + carry, v + carry, so that its evaluation adds no round-off.
/// Columns: those of a series, h, t, energy_error, drift, scatter, largest (the last three are of the whole run).
void writeEnergy(const Study& study, const RunFile& runs, const std::filesystem::path& file);

}  // namespace irk
