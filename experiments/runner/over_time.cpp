#include "experiments/runner/over_time.h"

#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "experiments/runs/run_spec.h"
#include "experiments/store/store.h"
#include "irk/misuse.h"
#include "irk/scene.h"

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

/// The times at which scenes start; each is made once.
class Starts {
 public:
  // A scene that cannot be made has no runs, and thus no times of them.
  double of(const RunSpec& spec) {
    const auto [known, is_new] = starts_.try_emplace({spec.scene, spec.settings}, kNone);
    if (!is_new) return known->second;
    try {
      known->second = makeScene<double>(spec.scene, settingsAtStep(spec)).start.t;
    } catch (const Misuse&) {
      return kNone;
    }
    return known->second;
  }

 private:
  static constexpr double kNone = -std::numeric_limits<double>::infinity();
  std::map<std::pair<std::string, Settings>, double> starts_;
};

/// Runs that differ in t_end only: their start, and the keys of all by their ends.
struct Ends {
  double start = 0;
  std::map<double, std::uint64_t> keys;
};

}  // namespace

std::unordered_set<std::uint64_t> earlierEnds(const Study& study) {
  if (differentEnds(study) < kEndsOverTime) return {};
  std::map<std::uint64_t, Ends> all;
  Starts starts;
  for (const Series& series : study.series) {
    for (const RunSpec& spec : series.runs) {
      if (std::isnan(spec.t_end)) continue;  // the scene's own: one end
      RunSpec endless = spec;
      endless.t_end = 1;
      Ends& ends = all[store::keyNumber(specKey(endless))];
      ends.start = starts.of(spec);  // `spec` is gone with its series
      ends.keys[spec.t_end] = store::keyNumber(specKey(spec));
    }
  }
  std::unordered_set<std::uint64_t> earlier;
  for (const auto& [name, ends] : all) {
    if (ends.keys.size() < kEndsOverTime) continue;
    const auto first = ends.keys.begin(), last = std::prev(ends.keys.end());
    for (auto end = first; end != ends.keys.end(); ++end) {
      const auto farthest = end->first < ends.start ? first : last;
      if (end != farthest) earlier.insert(end->second);
    }
  }
  return earlier;
}

}  // namespace irk
