// The command that makes a run again, from its row in runs.csv.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/tables/table.h"

namespace irk {

struct RunCommand {
  std::string series;  ///< `irk solve SCENE --method ID ...`: what all runs of a series have in common
  std::string swept;   ///< ` --tol 1e-06`, ` --step 0.01`: its own part
  /// What differs from the configuration, as field and value; scene, settings, method, ends and limits left out.
  std::vector<std::pair<std::string, std::string>> options;
};

/// Works on text alone: neither the scene nor the method of the row needs to be known to this program. Fields without
/// effect on the run are left out, because `irk solve` refuses them.
RunCommand commandOfRow(const Table& runs, const TableRow& row);

}  // namespace irk
