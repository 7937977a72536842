// profile.csv: which solver to use, over all problems of a study.
#pragma once

#include "experiments/tables/table.h"

namespace irk {

/// Performance profiles of Dolan & More (Math. Program. 91, 2002). A problem is a scene with its
/// settings at a target error; a solver a peer, or a configuration of the suite with its method and
/// treatment of discontinuities: the cheaper of two runs counts. From the rows of cpu_at_error.csv.
/// Columns: target_error (`all`: every target), integrator, ratio, fraction, given, problems: on
/// `fraction` of the `given` problems that the study gives to the solver, out of `problems` in all, it
/// takes at most `ratio` times the time of the best. Problems that no solver solves do not count, nor
/// those without a reference. One row per step of the curve, the last at ratio 1e6; a solver that never
/// gets there begins with ratio 1, fraction 0.
Table profileTable(const Table& costs);

}  // namespace irk
