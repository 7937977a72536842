// Detects steps that stay so small that the end is out of reach.
#pragma once

#include <cstdint>

#include "core/base/constants.h"

namespace irk {

/// Looks back once per kStallWindow attempts: an integration stalls if, at the pace of the last ones, the rest of the
/// interval would need kStallFactor times the attempts that are left. Without it such a run would end much later, at
/// the limit of attempts.
class StallDetector {
 public:
  void begin(double t) {
    *this = {};
    t_ = t;
  }
  /// After an attempt that led to time t: whether the integration stalls. `left`: attempts that are left.
  bool attempted(double t, double t_end, std::int64_t left) {
    if (++attempts_ % kStallWindow.whole() != 0) return false;
    const double needed = (t_end - t) * kStallWindow, affordable = kStallFactor * static_cast<double>(left) * (t - t_);
    t_ = t;
    return needed > affordable;
  }

 private:
  std::int64_t attempts_ = 0;
  double t_ = 0;
};

}  // namespace irk
