// Runs that give the error over time: they differ in t_end only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_set>

#include "experiments/study/study.h"

namespace irk {

/// Fewer than this many ends are runs of their own.
inline constexpr std::size_t kEndsOverTime = 10;

/// The keys of the runs that end before another run that differs in t_end only, where there are kEndsOverTime or more
/// of them. They take the same steps as the last one up to their ends: their errors are needed, their CPU times are
/// not. Of runs backward in time the last one is that with the earliest end.
std::unordered_set<std::uint64_t> earlierEnds(const Study& study);

}  // namespace irk
