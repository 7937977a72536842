// orders.csv: the observed order of every series of steps, with theory's value and a verdict.
#pragma once

#include "experiments/table.h"

namespace irk {

/// From the rows of runs.csv with fixed steps. Columns: scene, settings, formulation, family,
/// stages, component, order, confidence (95 %), h_min, h_max, points, theory, verdict, reason.
/// Verdict: `agrees` (within 0.2), `differs`, `not_measurable`, `no_theory`.
Table orderTable(const Table& runs);

/// Theory's order of a component ('u', 'v', 'x', 'z') for the run in this row; NaN if unknown.
double theoryFor(const Table& runs, const TableRow& row, char component);

}  // namespace irk
