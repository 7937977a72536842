// What an error estimate is multiplied by before it is compared with the tolerance.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/scheme.h"

namespace irk {

/// Errors of many steps add up: 1 in the first kFree steps, then more, so that the errors of N steps add up
/// to kFree (1 + log(N / kFree)) tolerances instead of N. For estimates of higher order than the step's own
/// nothing is needed: there the true error is far below them.
class Accumulation {
 public:
  void begin() { steps_ = 0; }
  void accepted() { ++steps_; }
  double factor() const { return std::max(1.0, static_cast<double>(steps_) / kFree); }

 private:
  static constexpr double kFree = 50;
  std::int64_t steps_ = 0;
};

/// 1 where the stages are as accurate as there are: else (Radau IA, Lobatto IIIC, IIID) stiff components
/// have the lower order of the stages, which no estimate of one step shows.
template <class Real>
double stiffCaution(const Scheme<Real>& scheme) {
  constexpr double kCaution = 10;
  return scheme.tableau.stage_order < scheme.s && scheme.s > 1 ? kCaution : 1;
}

}  // namespace irk
