// What did the paper get right? Counts of verdicts on its claims.
#pragma once

#include "experiments/claims/claims.h"
#include "experiments/report/answers/answer.h"

namespace irk::report {

/// A claim's id with its verdict.
using Verdicts = std::vector<std::pair<std::string, std::string>>;

Answer paperAnswer(const claims::ResultTables& tables);
/// The same for given verdicts, in their order of first appearance.
Answer paperAnswer(const Verdicts& verdicts);

}  // namespace irk::report
