// The solution over time, for figures.
#pragma once

#include <filesystem>

#include "experiments/runs/run.h"

namespace irk {

/// <scene>.<method>.csv, with the settings behind the scene where there are any.
std::filesystem::path trajectoryPath(const std::filesystem::path& folder, const RunSpec& spec);

/// Runs and writes columns t, h, error, newton_iterations, switches, components, outputs; the head
/// has the scene's diagrams (panelHead). Long runs are thinned: a row then holds the
/// smallest step since the row before it. Throws Misuse as `prepare`.
RunRecord executeWithTrajectory(const RunSpec& spec, const Watch& watch,
                                const std::filesystem::path& file);

}  // namespace irk
