#include "experiments/study/series_walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "experiments/study/series_rules.h"

namespace irk {

SeriesWalk::SeriesWalk(const Series& series) : series_(series) {
  if (series.end != SeriesEnd::kAsymptotic) return;
  std::vector<double> steps;
  for (const auto& run : series.runs) steps.push_back(run.options.step.h);
  planner_.emplace(std::move(steps), epsilonOf(series.runs.front().scalar));
}

std::optional<std::size_t> SeriesWalk::next() {
  if (planner_) return planner_->next();
  if (next_ == series_.runs.size()) return {};
  return next_++;
}

void SeriesWalk::record(std::size_t run, const RunFacts& facts) {
  const std::string_view outcome = facts.outcome;
  if (!planner_) {
    const bool too_long = series_.end == SeriesEnd::kTooLong && ranTooLong(outcome);
    if (too_long && last_too_long_ && !too_long_) too_long_ = run;
    last_too_long_ = too_long;
    return;
  }
  if (outcome == name(Outcome::kSuccess)) {
    planner_->record(run, facts.errors);
  } else {
    planner_->recordFailure(run);
  }
  if (outcome == "refused" || ranTooLong(outcome)) planner_->endProbe();
}

std::size_t expectedRuns(const Series& series) {
  if (series.end != SeriesEnd::kAsymptotic) return series.runs.size();
  return std::min(kPlannedRuns, series.runs.size());
}

SeriesState stateOf(const Series& series, const std::function<std::optional<RunFacts>(std::size_t)>& facts) {
  SeriesState state;
  SeriesWalk walk(series);
  while (const auto run = walk.next()) {
    if (const auto known = facts(*run)) {
      state.found.push_back(*run);
      walk.record(*run, *known);
      continue;
    }
    state.missing.push_back(*run);
    if (series.end != SeriesEnd::kAsymptotic) continue;
    const std::size_t known = state.found.size() + 1, expected = expectedRuns(series);
    state.unplanned = expected > known ? expected - known : 0;
    break;
  }
  return state;
}

std::string kindOf(const RunSpec& spec, SeriesEnd end) {
  const auto& tolerances = spec.options.tolerances;
  const bool planned = end == SeriesEnd::kAsymptotic;
  return fmt::format("{} {} {} {} {:g} {:g}", spec.scene, settingsText(spec.settings), idOf(spec.formulation),
                     planned ? spec.method : "", planned ? 0 : spec.options.step.h,
                     std::max(tolerances.rtol, tolerances.atol));
}

}  // namespace irk
