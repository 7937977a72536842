#include "experiments/audit/judge.h"

#include <algorithm>
#include <cmath>

namespace irk::audit {
namespace {

constexpr std::string_view kNames[] = {"right", "failed", "wrong", "ill_conditioned", "unjudged"};
constexpr double kRoundOff = std::numeric_limits<double>::epsilon();
constexpr double kAccuracyOfBar = 0.1;

}  // namespace

std::span<const std::string_view> judgementNames() { return kNames; }

std::string_view nameOf(Judgement judgement) { return kNames[static_cast<std::size_t>(judgement)]; }

double bar(double tolerance) { return 1000 * tolerance + 1e-9; }

Judgement judge(const Evidence& e) {
  if (e.kappa > kLargestKappa || e.kappa * kRoundOff > e.tolerance) return Judgement::kIllConditioned;
  if (!e.success) return Judgement::kFailed;
  const bool known = e.accuracy <= kAccuracyOfBar * bar(e.tolerance);
  if (!known || std::isnan(e.error)) return Judgement::kUnjudged;
  return e.error > bar(e.tolerance) ? Judgement::kWrong : Judgement::kRight;
}

double accumulated(double steps, double kappa, double tolerance) {
  return std::isnan(kappa) ? kappa : steps * std::max(kappa, 1.0) * tolerance;
}

double scaledDifference(const Vec<double>& y, const Vec<double>& reference, const Vec<double>& scale, Index first,
                        Index last) {
  double largest = std::numeric_limits<double>::quiet_NaN();
  for (Index i = first; i < last; ++i) {
    if (std::isnan(reference[i])) continue;
    const double magnitude = std::max(std::abs(reference[i]), i < scale.size() ? scale[i] : 1.0);
    const double difference = std::abs(y[i] - reference[i]) / magnitude;
    if (!std::isfinite(difference)) return std::numeric_limits<double>::infinity();
    if (!(largest >= difference)) largest = difference;
  }
  return largest;
}

}  // namespace irk::audit
