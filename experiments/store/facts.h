// What a stored row says about the runs after it.
#pragma once

#include "experiments/store/rows.h"
#include "experiments/study/series_walk.h"

namespace irk::store {

/// With errors only where the series is planned: they have to be read again.
RunFacts factsOf(const Rows& runs, const Entry& entry, bool planned);

}  // namespace irk::store
