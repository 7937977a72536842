#include "experiments/audit/coverage.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "experiments/audit/thresholds.h"

namespace irk::audit {

double partOfCover(const MeasuredResult& r, Index judged) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  if (r.bars.size() != r.state.size() || r.reference.size() != r.state.size()) return kUnknown;
  double largest = kUnknown;
  for (Index i = 0; i < r.state.size(); ++i) {
    if (std::isnan(r.bars[i]) && i < judged) return kUnknown;
    if (std::isnan(r.bars[i]) || std::isnan(r.reference[i])) continue;
    const double scale = i < r.scale.size() ? r.scale[i] : 1;
    const double magnitude = std::max(std::abs(r.reference[i]), scale);
    const double tolerance = r.tolerances.of(scale, r.state[i]);
    const double cover = kCoverageFactor * (r.bars[i] + tolerance) + (kCoverageRoundOff + r.accuracy) * magnitude;
    const double part = std::abs(r.state[i] - r.reference[i]) / cover;
    // Not a number: neither the result nor its bar is finite, or there is no solution.
    largest = std::fmax(largest, std::isnan(part) ? std::numeric_limits<double>::infinity() : part);
  }
  return largest;
}

double errorInTolerances(const MeasuredResult& r, Index judged) {
  double largest = std::numeric_limits<double>::quiet_NaN();
  for (Index i = 0; i < judged; ++i) {
    if (std::isnan(r.reference[i])) continue;
    const double scale = i < r.scale.size() ? r.scale[i] : 1;
    const double size = std::abs(r.state[i] - r.reference[i]) / r.tolerances.of(scale, r.reference[i]);
    largest = std::fmax(largest, std::isfinite(size) ? size : std::numeric_limits<double>::infinity());
  }
  return largest;
}

}  // namespace irk::audit
