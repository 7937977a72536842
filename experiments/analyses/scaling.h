// scaling.csv: the cost of a step with many unknowns, stages and threads.
#pragma once

#include <iosfwd>

#include "experiments/analyses/run_file.h"
#include "experiments/study/study.h"

namespace irk {

/// Repeats every successful run of the study serially and takes the median time of its accepted steps, including
/// rejected attempts before them. The first three steps do not count, because the start finds the pattern of the
/// Jacobian and the order of elimination. Columns: those of a series, n (unknowns of one stage), step_s (wall clock),
/// step_cpu_s (of the calling thread), iterations (of Newton per step).
Table scalingTable(const Study& study, const RunFile& runs, std::ostream& progress);

/// Least-squares slopes of the log of the time of a step, step_cpu_s of one thread and step_s of several, over log n
/// for n >= 200 and over log stages, from rows of scaling.csv that differ in nothing else. Columns: scene, formulation,
/// solver, storage, threads, over (`n` or `stages`), at (the value of the fixed one: method, or n), slope, confidence
/// (95 %), points.
Table scalingSlopes(const Table& scaling);

}  // namespace irk
