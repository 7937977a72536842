// What did the paper get right? Counts of verdicts on its claims, in its own setting and in the suite's best.
#pragma once

#include "experiments/claims/claims.h"
#include "experiments/report/answers/answer.h"

namespace irk::report {

/// A claim with its verdicts by setting (claims::kSettings).
struct ClaimVerdicts {
  std::string id, title;
  std::array<std::string, 2> verdicts;
  std::array<bool, 2> partly = {};  ///< contradicted, but a part of it is confirmed
};

Answer paperAnswer(const claims::ResultTables& tables);
/// The same for given verdicts, in their order of first appearance.
Answer paperAnswer(const std::vector<ClaimVerdicts>& claims);

}  // namespace irk::report
