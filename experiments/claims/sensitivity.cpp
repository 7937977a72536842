#include "experiments/claims/sensitivity.h"

#include <algorithm>

namespace irk::claims {
namespace {

Range scaled(Range range, double factor) {
  if (range.isTwoSided()) {
    const double middle = (range.low + range.high) / 2, half = (range.high - range.low) / 2;
    range.low = middle - factor * half;
    range.high = middle + factor * half;
  } else {
    range.low *= factor;
    range.high *= factor;
  }
  return range;
}

}  // namespace

Part scaledThreshold(const Part& part, double factor) {
  Part scaled_part = part;
  if (part.statistic == Statistic::kShare) {
    scaled_part.confirmed.low = std::max(1 - factor * (1 - part.confirmed.low), 0.0);
  } else if (part.statistic == Statistic::kExistence) {
    scaled_part.clean = scaled(part.clean, factor);
  } else {
    scaled_part.confirmed = scaled(part.confirmed, factor);
  }
  return scaled_part;
}

Sensitivity sensitivityOf(const Part& part, const Measurement& measured) {
  Sensitivity result{scaledThreshold(part, 0.5), scaledThreshold(part, 2), {}, {}, {}};
  result.halved = judge(result.halved_part, measured).verdict;
  result.doubled = judge(result.doubled_part, measured).verdict;
  for (const auto& scene : judge(part, measured).scenes) {
    Measurement rest = measured;
    std::erase_if(rest.cases, [&](const Case& one) { return one.scene == scene; });
    result.without.emplace_back(scene, judge(part, rest, kAnySample));
  }
  return result;
}

}  // namespace irk::claims
