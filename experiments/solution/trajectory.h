// The solution over time, for figures.
#pragma once

#include <filesystem>

#include "experiments/solution/rows.h"

namespace irk {

/// <scene>.<method>.csv; settings, if any, follow the scene's name. In the path of a tableau file _ stands for /.
std::filesystem::path trajectoryPath(const std::filesystem::path& folder, const RunSpec& spec);

/// Runs the spec and writes its rows at `times` with the columns and the head of solutionTable, so also the scene's
/// diagrams (panelHead). Long runs are thinned: a row then has the smallest step since the previous row. Throws Misuse
/// as `prepare` and SolutionRows.
RunRecord executeWithTrajectory(const RunSpec& spec, const Watch& watch, const std::filesystem::path& file,
                                const RowTimes& times = {});

}  // namespace irk
