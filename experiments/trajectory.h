// The solution over time, for figures.
#pragma once

#include <filesystem>

#include "experiments/run.h"

namespace irk {

/// <scene>.csv, with the settings in its name where there are any.
std::filesystem::path trajectoryPath(const std::filesystem::path& folder, const RunSpec& spec);

/// Runs and writes columns t, components, outputs; long runs are thinned. Throws Misuse as
/// `prepare`.
RunRecord executeWithTrajectory(const RunSpec& spec, const Watch& watch,
                                const std::filesystem::path& file);

}  // namespace irk
