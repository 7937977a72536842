// The command that makes a run again, from its row in runs.csv.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/tables/table.h"

namespace irk {

struct SeriesCommand {
  std::string text;  ///< `irk solve SCENE --method ID ...`
  /// What differs from the configuration, as field and value; scene, settings, method, ends and limits left out.
  std::vector<std::pair<std::string, std::string>> options;
};

/// The part of the command that all runs of the row's series share. It is made from the text alone: this program need
/// not have the scene or the method. Fields without effect on the run are left out, because `irk solve` refuses them.
SeriesCommand seriesCommand(const Table& runs, const TableRow& row);

/// The run's own part, to be appended: ` --tol 1e-06`, ` --step 0.01`.
std::string sweptOptions(const Table& runs, const TableRow& row);

}  // namespace irk
