// profile.csv: performance profiles of the solvers over all problems of a study.
#pragma once

#include <filesystem>

namespace irk {

/// Performance profiles of Dolan & More (Math. Program. 91, 2002), from the rows of cpu_at_error.csv. A problem is a
/// scene with its settings and its end, at a target error. A solver is a peer, or a configuration of the suite with its
/// method and treatment of switches; if it has two runs of a problem, the cheaper one counts. Columns: collection
/// (`all` for all scenes), target_error (`all` for every target), integrator, ratio, fraction, given, problems. The
/// solver was given `given` of the study's `problems` problems; on `fraction` of those it takes at most `ratio` times
/// the time of the best solver. Problems that no solver solves, and those without a reference, do not count; nor do
/// scenes to which a solver cannot be applied (refused runs), and errors below a solver's smallest tolerance
/// (least_tolerance), which it was never asked for. There is one row per step of the curve, the last one at ratio 1e6;
/// a curve without other steps begins with ratio 1, fraction 0.
void writeProfile(const std::filesystem::path& costs, const std::filesystem::path& file);

}  // namespace irk
