// The keys of the runs of a series, computed together.
#pragma once

#include <cstdint>
#include <vector>

#include "experiments/study/study.h"

namespace irk {

/// One key for each run, in the order of the series: those of specKey, in a third of its time.
std::vector<std::uint64_t> keysOf(const Series& series);

}  // namespace irk
