#include "experiments/runner/schedule/costs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "core/options/fixed_steps.h"
#include "experiments/runs/run_table.h"
#include "experiments/runs/setup.h"
#include "irk/scene.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

// The number of unknowns of a scene with its settings. Finding it builds the scene, so it is cached.
class Unknowns {
 public:
  double of(const RunSpec& spec) {
    const auto [at, added] = known_.try_emplace({spec.scene, settingsText(spec.settings)}, 0);
    if (added) {
      const State<double> start = sceneOf<double>(spec).start;
      at->second = static_cast<double>(start.u.size() + start.x.size() + start.z().size());
    }
    return at->second;
  }

 private:
  std::map<std::pair<std::string, std::string>, double> known_;
};

// Expected number of steps, proportional to tol^(-1 / (order + 1)). With fixed steps it is 1 / h up to the unknown
// length of the interval.
double expectedSteps(const RunSpec& spec, double stages) {
  if (hasFixedSteps(spec.options.step)) return 1 / spec.options.step.h;
  const double tol = std::max(spec.options.tolerances.rtol, spec.options.tolerances.atol);
  constexpr double kMaxOrder = 8;
  return std::pow(tol, -1 / (1 + std::min(2 * stages - 1, kMaxOrder)));
}

double sumOf(const std::vector<double>& seconds) { return std::accumulate(seconds.begin(), seconds.end(), 0.0); }

}  // namespace

std::vector<double> guessedCosts(const Series& series) {
  static thread_local Unknowns unknowns;
  const RunSpec first = series.runs.front();
  const double given = static_cast<double>(isFamily(first.method) ? 5 : stagesInId(first.method));
  const double stages = std::max(given, 1.0);
  const double digits = first.scalar.isDouble() ? 1 : 20 + 0.2 * first.scalar.digits;
  std::vector<double> costs;
  for (const auto& spec : series.runs) {
    costs.push_back(stages * (unknowns.of(first) + 3) * digits * expectedSteps(spec, stages));
  }
  // Estimates vary more than measured times do. The square root of the sum balances the shards best, judged by the
  // times of the quick studies.
  const double scale = 1 / std::sqrt(sumOf(costs));
  for (double& cost : costs) cost *= scale;
  return costs;
}

double expectedCost(const Series& series) { return sumOf(guessedCosts(series)); }

Costs::Costs(const Study& study, KeysOfSeries keys, const store::Rows& rows)
    : study_(study), keys_(std::move(keys)), rows_(rows) {
  if (rows.size() == 0) return;
  for (std::size_t i = 0; i < study.series.size(); ++i) {
    const Series series = study.series[i];
    const double seconds = sumOf(measured(i, series)), guess = expectedCost(series);
    if (std::isnan(seconds)) continue;
    for (Scale* scale : {&scenes_[series.runs.front().scene], &all_}) {
      scale->measured += seconds;
      scale->guessed += guess;
    }
  }
}

// All NaN if the series has no rows. A failed run that was not made took no time.
std::vector<double> Costs::measured(std::size_t index, const Series& series) const {
  const auto keys = keys_(index);
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> seconds(keys.size(), kNone);
  double sum = 0;
  std::size_t found = 0;
  for (std::size_t run = 0; run < keys.size(); ++run) {
    const auto entry = rows_.find(keys[run]);
    if (!entry) continue;
    const double its = numberAt(names_, rows_.row(*entry), "cpu_s");
    const int times = rows_.name(entry->outcome) == name(Outcome::kSuccess) ? series.runs[run].reference_times : 1;
    seconds[run] = std::isnan(its) ? 0 : its * (times + 1) / 2;  // runs to k / times of t_end, k = 1, 2, ...
    sum += seconds[run];
    ++found;
  }
  // The planner of steps will make about the same runs again.
  const bool same = series.end == SeriesEnd::kAsymptotic && found > 0;
  const double mean = same ? 0 : sum / static_cast<double>(found);  // 0 / 0 without rows
  for (double& its : seconds) its = std::isnan(its) ? mean : its;
  return seconds;
}

std::vector<double> Costs::of(std::size_t index) const {
  const Series series = study_.series[index];
  if (rows_.size() > 0) {
    auto seconds = measured(index, series);
    if (!std::isnan(seconds.front())) return seconds;
  }
  auto costs = guessedCosts(series);
  if (!(all_.measured > 0)) return costs;
  const auto at = scenes_.find(series.runs.front().scene);
  const Scale& scale = at != scenes_.end() && at->second.measured > 0 ? at->second : all_;
  for (double& cost : costs) cost *= scale.measured / scale.guessed;
  return costs;
}

}  // namespace irk
