// Where do methods fail? How runs end, by solver and by cause.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "experiments/claims/result_tables.h"
#include "experiments/report/answers/answer.h"

namespace irk::report {

/// From the runs of work_precision: the same problems and tolerances for every solver.
Answer failureAnswer(const claims::ResultTables& tables);

/// `too many steps` for `max_steps`; an unknown outcome is returned as it is.
std::string causeTitle(std::string_view outcome);

/// How many of the audit's successes are wrong; empty without the audit.
std::string wrongSentence(const claims::ResultTables& tables);

/// Counts of a study's outcomes: `1200 runs, 1100 successful; 60 end as too many steps (max_steps), 40 as ...`.
std::string outcomeSentence(const Table& runs);

}  // namespace irk::report
