// The middle of a sample.
#pragma once

#include <vector>

namespace irk {

/// The mean of the two middle values of an even number; NaN of nothing.
double median(std::vector<double> values);

}  // namespace irk
