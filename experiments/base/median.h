// The median of a sample.
#pragma once

#include <vector>

namespace irk {

/// For an even number of values, the mean of the two middle ones; NaN for an empty sample.
double median(std::vector<double> values);

}  // namespace irk
