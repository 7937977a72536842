// ratios.csv: what each choice of a block costs, relative to the first one, at equal errors.
#pragma once

#include <filesystem>
#include <vector>

#include "experiments/analyses/run_file.h"

namespace irk {

/// The columns of ratios.csv that hold ratios.
inline constexpr const char* kRatioCosts[] = {"cpu_s", "residuals", "newton_iterations", "jacobians", "factorizations"};

/// Compares the series of each block that are equal but for one column, as `jacobian`: each value of that column with
/// the block's first value. Scenes, settings and methods are not compared with each other. One row each: block, scene,
/// settings, method, column, value, base, others (the other columns that vary in the block, `newton=modified`), errors
/// (how many of `targets` both reach), the medians over these errors of the ratios of kRatioCosts, lost and won (how
/// many errors only the base reaches, and only the other value).
void writeRatios(const RunFile& runs, const std::vector<double>& targets, const std::filesystem::path& file);

}  // namespace irk
