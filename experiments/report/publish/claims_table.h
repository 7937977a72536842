// Verdicts and numbers of all claims as a table.
#pragma once

#include "experiments/claims/claims.h"
#include "experiments/tables/table.h"

namespace irk::report {

/// A row per part of a claim and setting (claims::kSettings). Columns: claim, part, setting, title, measured,
/// condition, verdict, value, low, high (the 90 % interval), unit, cases, scenes, reason. `value` is nan without cases.
/// No head.
Table claimsTable(const std::vector<claims::ClaimFindings>& findings);

}  // namespace irk::report
