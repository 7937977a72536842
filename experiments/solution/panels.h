// The diagrams of a scene's solution. plots/scene_solution.gp reads them from the head of a trajectory.
#pragma once

#include "experiments/tables/table.h"
#include "irk/scene.h"

namespace irk {

/// The components u, v, x, z and the outputs with their units, in the order of PreparedRun::columns.
std::vector<std::pair<std::string, std::string>> namesAndUnits(const Scene<double>& scene);

/// The head entries `time: t in s` and `panels: "label|columns|factor" ...`; a label names the unit of its columns
/// times the factor. Uses the entry's panels, without the columns that the scene lacks with its settings; an entry
/// without panels gets one for each component and output, or for eight of them, and an entry `panels_note` that says
/// so.
TableHead panelHead(const SceneEntry& entry, const Scene<double>& scene);

}  // namespace irk
