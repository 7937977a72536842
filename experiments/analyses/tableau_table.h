// Tables of tableaus: one row of properties per method, and the zeros and poles of R(z).
#pragma once

#include <string>
#include <vector>

#include "experiments/tables/table.h"

namespace irk {

/// The column names of both tables are those of TableauProperties and its parts.
struct TableauTables {
  /// One row per method: order, stage order, degrees, error constant, stability, conditions.
  Table properties;
  /// One row per zero and pole of R: R(z) = prod (1 - z / zero) / prod (1 - z / pole).
  Table stability;
};

/// The tables for ids or files. Throws Misuse as findTableau and analyzeProperties.
TableauTables tableauTables(const std::vector<std::string>& methods);

/// The ids of all families' members with up to `most` stages.
std::vector<std::string> familyMembers(int most);

}  // namespace irk
