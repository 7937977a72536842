#include "experiments/runner/costs.h"

#include <algorithm>
#include <cmath>
#include <map>
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

/// The sums of measured and of guessed seconds.
struct Scale {
  double measured = 0, guessed = 0;
  void add(double seconds, double guess) {
    measured += seconds;
    guessed += guess;
  }
};

/// The seconds of runs in their rows. A failed run that was not made took none.
class Measured {
 public:
  explicit Measured(const store::Rows& rows) : rows_(rows) {}

  // NaN if the series has no rows.
  double seconds(const Series& series, const std::vector<std::uint64_t>& keys) const {
    double sum = 0;
    std::size_t found = 0;
    for (const auto key : keys) {
      const auto entry = rows_.find(key);
      if (!entry) continue;
      const double seconds = numberAt(names_, rows_.row(*entry), "cpu_s");
      sum += std::isnan(seconds) ? 0 : seconds;
      ++found;
    }
    // The planner of steps will make about the same runs again.
    if (series.end == SeriesEnd::kAsymptotic && found > 0) return sum;
    return sum * static_cast<double>(keys.size()) / static_cast<double>(found);  // 0 / 0 without rows
  }

 private:
  const store::Rows& rows_;
  const Table names_{{}, runColumns(), {}};
};

}  // namespace

double expectedCost(const Series& series) {
  static thread_local Unknowns unknowns;
  const RunSpec first = series.runs.front();
  const double given = static_cast<double>(isFamily(first.method) ? 5 : stagesInId(first.method));
  const double stages = std::max(given, 1.0);
  const double digits = first.scalar.isDouble() ? 1 : 20 + 0.2 * first.scalar.digits;
  const double step = stages * (unknowns.of(first) + 3) * digits;
  double cost = 0;
  for (const auto& spec : series.runs) cost += step * expectedSteps(spec, stages);
  // Estimates vary more than measured times do. Their square root balances the shards best, judged by the times of the
  // quick studies.
  return std::sqrt(cost);
}

std::vector<double> expectedCosts(const Study& study, const KeysOfSeries& keys, const store::Rows& rows) {
  std::vector<double> costs(study.series.size());
  std::vector<bool> is_guess(costs.size(), true);
  std::map<std::string, Scale> scenes;
  Scale all;
  const Measured measured(rows);
  for (std::size_t i = 0; i < costs.size(); ++i) {
    const Series series = study.series[i];
    costs[i] = expectedCost(series);
    const double seconds = rows.size() == 0 ? std::nan("") : measured.seconds(series, keys(i));
    if (std::isnan(seconds)) continue;
    scenes[series.runs.front().scene].add(seconds, costs[i]);
    all.add(seconds, costs[i]);
    costs[i] = seconds;
    is_guess[i] = false;
  }
  if (!(all.measured > 0)) return costs;
  for (std::size_t i = 0; i < costs.size(); ++i) {
    if (!is_guess[i]) continue;
    const auto at = scenes.find(study.series[i].runs.front().scene);
    const Scale& scale = at != scenes.end() && at->second.measured > 0 ? at->second : all;
    costs[i] *= scale.measured / scale.guessed;
  }
  return costs;
}

}  // namespace irk
