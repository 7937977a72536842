#include "experiments/study/study.h"

#include <algorithm>

namespace irk {

std::vector<int> divisions(int most) {
  constexpr double kRatio = 1.1;
  std::vector<int> all;
  for (int n = 2; n <= most; n = std::max(n + 2, 2 * static_cast<int>(std::lround(n * kRatio / 2)))) {
    all.push_back(n);
  }
  return all;
}

SpecsByKey::SpecsByKey(const Study& study) : study_(study) {
  for (std::size_t i = 0; i < study.series.size(); ++i) {
    const SeriesRuns& runs = study.series[i].runs;
    for (std::size_t run = 0; run < runs.size(); ++run) places_[specKey(runs[run])] = {i, run};
  }
}

std::optional<RunSpec> SpecsByKey::find(const std::string& key) const {
  const auto found = places_.find(key);
  if (found == places_.end()) return {};
  const auto& [series, run] = found->second;
  return study_.series[series].runs[run];
}

}  // namespace irk
