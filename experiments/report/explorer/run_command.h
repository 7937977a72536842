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

/// What all runs of the row's series have in common. Works on text alone: neither the scene nor the method of the row
/// needs to be known to this program. Fields without effect on the run are left out, because `irk solve` refuses them.
SeriesCommand seriesCommand(const Table& runs, const TableRow& row);

/// The run's own part, to be appended: ` --tol 1e-06`, ` --step 0.01`.
std::string sweptOptions(const Table& runs, const TableRow& row);

}  // namespace irk
