// The expected time of a study's series: from the times of an earlier table where there is one, else a guess.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "experiments/store/rows.h"
#include "experiments/study/study.h"

namespace irk {

/// A guess of the time of a series, in arbitrary units, from the number of its runs, stages, unknowns and tolerances.
double expectedCost(const Series& series);

/// The keys of a series by its number.
using KeysOfSeries = std::function<std::vector<std::uint64_t>(std::size_t series)>;

/// The expected time of each series. Rows of any code and machine count, because only ratios matter. A run with a row
/// takes the time of that row; a run without one takes the mean of its series. A series without rows takes its guess,
/// scaled by the measured times of the other series of its scene, or of all series. Without any rows the unit is that
/// of `expectedCost`.
std::vector<double> expectedCosts(const Study& study, const KeysOfSeries& keys, const store::Rows& rows);

}  // namespace irk
