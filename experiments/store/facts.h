// The facts of a stored row that decide about later runs of its series.
#pragma once

#include "experiments/store/rows.h"
#include "experiments/study/series_walk.h"

namespace irk::store {

/// Includes the errors only if the series is planned: they must be read from the file again.
RunFacts factsOf(const Rows& runs, const Entry& entry, bool planned);

}  // namespace irk::store
