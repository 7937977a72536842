// Detects steps that stay so small that the end is out of reach.
#pragma once

#include <algorithm>
#include <cstdint>

namespace irk {

/// Compares steps once per window of attempts. An integration stalls if its largest step has not grown for kWindows
/// windows and the rest of the interval would need kFarOut times the attempts that are left. Transients end sooner.
/// Without this detector such a run would end much later, at the limit of attempts.
class StallDetector {
 public:
  void begin(double t) {
    *this = {};
    t_ = t;
  }
  /// After an attempt of size h that led to time t: whether the integration stalls. `left`: attempts that are left.
  bool attempted(double t, double h, double t_end, std::int64_t left) {
    largest_ = std::max(largest_, h);
    if (++attempts_ % kWindow != 0) return false;
    windows_ = largest_ <= kGrowth * before_ ? windows_ + 1 : 0;
    const bool out_of_reach =
        (t_end - t) * static_cast<double>(kWindow) > kFarOut * static_cast<double>(left) * (t - t_);
    before_ = largest_;
    largest_ = 0;
    t_ = t;
    return windows_ >= kWindows && out_of_reach;
  }

 private:
  static constexpr std::int64_t kWindow = 1000;
  static constexpr int kWindows = 50;
  static constexpr double kFarOut = 10;
  static constexpr double kGrowth = 1.5;
  std::int64_t attempts_ = 0;
  int windows_ = 0;
  double t_ = 0, largest_ = 0, before_ = 0;
};

}  // namespace irk
