// The rows of runs that are not made because easier ones of their series took too long.
#pragma once

#include "experiments/store/store.h"
#include "experiments/study/study.h"

namespace irk {

/// Stores a row for each run behind two in a row of its series that took too long, with their outcome, even if several
/// workers have made the run before that was known: the rows are those of one worker. Call it when all ranks have
/// ended; `store` has the rows of all.
void recordSkippedRuns(const Study& study, const store::RunKeys& keys, store::Store& store);

}  // namespace irk
