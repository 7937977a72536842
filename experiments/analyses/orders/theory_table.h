// order_theory.csv: the theoretical orders of the families of a study for every number of stages, measured or not.
#pragma once

#include <filesystem>

#include "experiments/analyses/run_file.h"

namespace irk {

/// From runs.csv: for each scene, settings and formulation, each of its families and components, and every number of
/// stages from one below the smallest to one above the largest there. Figures draw theory from it, so that numbers of
/// stages that were not measured do not hide the steps between even and odd ones. Rows without a known order are left
/// out.
void writeTheory(const RunFile& runs, const std::filesystem::path& file);

}  // namespace irk
