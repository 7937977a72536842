// orders.csv: the observed order of every series of steps, with theory's value and a verdict.
#pragma once

#include "experiments/tables/table.h"

namespace irk {

/// From the rows of runs.csv with fixed steps. Columns: scene, settings, formulation, scalar,
/// family, stages, component, power_of, order, confidence (95 %), h_min, h_max, points, theory,
/// source, verdict, reason, block (of the finest run). power_of: `h`, or `z` for the exponent of |z|
/// at a fixed step, from series whose only difference is a setting `z/h`; h_min and h_max are then 1/|z|. source: where
/// theory's value comes from (theory.h), or `tableau`: a user's own claim. Verdict: `agrees`
/// (within orderTolerance), `differs`, `not_measurable`, `no_theory`.
Table orderTable(const Table& runs);

}  // namespace irk
