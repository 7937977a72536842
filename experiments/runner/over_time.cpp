#include "experiments/runner/over_time.h"

#include <cmath>
#include <iterator>
#include <map>
#include <string>

#include "experiments/runs/run_spec.h"
#include "experiments/store/store.h"

namespace irk {

std::unordered_set<std::uint64_t> earlierEnds(const Study& study) {
  std::map<std::string, std::map<double, std::uint64_t>> ends;  // of all that is equal
  for (const Series& series : study.series) {
    for (const RunSpec& spec : series.runs) {
      if (std::isnan(spec.t_end)) continue;  // the scene's own: one end
      RunSpec endless = spec;
      endless.t_end = 1;
      ends[specKey(endless)][spec.t_end] = store::keyNumber(specKey(spec));
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
