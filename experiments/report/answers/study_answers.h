// What the tables of one study show, in sentences.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiments/claims/result_tables.h"

namespace irk::report {

/// The answer to a study's question, as far as its tables give one: the cheapest value of the column that the study
/// compares, the check of orders, the audit's wrong successes. Then how its runs ended. Empty without results.
std::vector<std::string> studyAnswers(std::string_view study, const claims::ResultTables& tables);

}  // namespace irk::report
