#include "experiments/runner/over_time.h"

#include <cmath>
#include <iterator>
#include <map>
#include <set>

#include "experiments/runs/run_spec.h"
#include "experiments/store/store.h"

namespace irk {

namespace {

// Few studies have ends over time, and finding them needs memory for every run.
std::size_t differentEnds(const Study& study) {
  std::set<double> ends;
  for (const Series& series : study.series) {
    const double end = series.runs.front().t_end;
    if (!std::isnan(end)) ends.insert(end);
  }
  return ends.size();
}

}  // namespace

std::unordered_set<std::uint64_t> earlierEnds(const Study& study) {
  if (differentEnds(study) < kEndsOverTime) return {};
  std::map<std::uint64_t, std::map<double, std::uint64_t>> ends;  // of all that is equal
  for (const Series& series : study.series) {
    for (const RunSpec& spec : series.runs) {
      if (std::isnan(spec.t_end)) continue;  // the scene's own: one end
      RunSpec endless = spec;
      endless.t_end = 1;
      ends[store::keyNumber(specKey(endless))][spec.t_end] = store::keyNumber(specKey(spec));
    }
  }
  std::unordered_set<std::uint64_t> earlier;
  for (const auto& [name, of_run] : ends) {
    if (of_run.size() < kEndsOverTime) continue;
    for (auto end = of_run.begin(); std::next(end) != of_run.end(); ++end) earlier.insert(end->second);
  }
  return earlier;
}

}  // namespace irk
