// orders.csv: the observed order of every series of steps, the theoretical order, and a verdict.
#pragma once

#include <filesystem>

#include "experiments/analyses/run_file.h"

namespace irk {

/// Computed from the rows of runs.csv with fixed steps. Columns: scene, settings, formulation, multipliers,
/// scalar, method, family, stages, component, power_of, order, confidence (95 %), h_min, h_max, points, theory, source,
/// verdict, reason, block (of the finest run). power_of is `h`, or `z` for the exponent of |z| at a fixed step, which
/// is fitted over series that differ only in a setting `z/h`; h_min and h_max are then 1/|z|. source is the origin of
/// the theoretical value (theory.h), or `tableau` for an order that a user's file declares. Verdicts: `agrees` (within
/// orderTolerance), `differs`, `not_measurable`, `no_theory`.
void writeOrders(const RunFile& runs, const std::filesystem::path& file);

}  // namespace irk
