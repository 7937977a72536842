// Errors of many steps add up.
#pragma once

#include <algorithm>
#include <cstdint>

namespace irk {

/// What estimates of the solution's own error are multiplied by: 1 in the first kFree steps, then more, so
/// that the errors of N steps add up to kFree (1 + log(N / kFree)) tolerances instead of N. For estimates
/// of higher order than the step's own nothing is needed: there the true error is far below them.
class Accumulation {
 public:
  void begin() { steps_ = 0; }
  void accepted() { ++steps_; }
  double factor() const { return std::max(1.0, static_cast<double>(steps_) / kFree); }

 private:
  static constexpr double kFree = 50;
  std::int64_t steps_ = 0;
};

}  // namespace irk
