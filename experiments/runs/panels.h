// The diagrams of a scene's solution, as plots/scene_solution.gp reads them from a trajectory's head.
#pragma once

#include "experiments/tables/table.h"
#include "irk/scene.h"

namespace irk {

/// `time: t in s` and `panels: "label|columns|factor" ...`, where a label has the unit of its columns times the factor.
/// The entry's panels, of them the columns that the scene has with its settings; without any, one panel for each of the
/// first components and outputs.
TableHead panelHead(const SceneEntry& entry, const Scene<double>& scene);

}  // namespace irk
