// The runs that the explorer shows, as JSON.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

namespace irk {

/// The studies in `results` whose runs the explorer shows: those that sweep tolerances or steps for errors and costs,
/// and the user's own.
std::vector<std::string> exploredStudies(const std::filesystem::path& results);

/// Writes one object; memory does not grow with the runs, but for 44 bytes per series (RunFile) and 40 per distinct
/// text:
///   studies  [{id, title, no_times: why there are no CPU times, or ""}]
///   series   [{study, scene, settings, t_end, method, family, stages, peer, integrator, options: [[field, value]],
///            command}]; runs of one series differ in tolerances and steps only
///   words    {column: [text]}: the texts that runs refer to by their number, for outcome, detail and swept
///   runs     {column: [value of each run]}: series, outcome, detail, swept (the end of the command), tolerance, wrong
///            (1: a success whose error in u, v or x is above the bar of experiments/audit/judge.h), and every column
///            of runs.csv that is an error, a counter or a time, with four digits; null: unknown
/// Safe inside <script> (no '<') and against placeholders (no '@').
void writeExplorerData(const std::filesystem::path& results, std::ostream& out);

}  // namespace irk
