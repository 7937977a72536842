// The table of claims for the report's page.
#pragma once

#include <filesystem>
#include <string>

#include "experiments/claims/result_tables.h"

namespace irk::claims {

/// A table of class `claims`; a row of class `claim` and the claim's id, with the verdicts' words as classes of their
/// cells (`verdict confirmed`). Behind <details> of class `protocol`: measurement, thresholds, sensitivity, history,
/// commands and links to those of its figures that exist in the folder.
std::string claimsHtml(const ResultTables& tables, const std::filesystem::path& figures);

}  // namespace irk::claims
