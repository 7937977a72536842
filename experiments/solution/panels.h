// The diagrams of a scene's solution. plots/scene_solution.gp reads them from the head of a trajectory.
#pragma once

#include "experiments/tables/table.h"
#include "irk/scene.h"

namespace irk {

/// The components u, v, x, z and the outputs with their units, in the order of PreparedRun::columns.
std::vector<std::pair<std::string, std::string>> namesAndUnits(const Scene<double>& scene);

/// The head entries `time: t in s` and `panels: "label|columns|factor" ...`; a label names the unit of its columns
/// times the factor. Uses the entry's panels, without the columns that the scene lacks with its settings. An entry
/// without panels gets one for each component and output; if these are more than eight, it gets eight, and
/// `panels_note` says so.
TableHead panelHead(const SceneEntry& entry, const Scene<double>& scene);

}  // namespace irk
