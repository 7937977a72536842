#include "experiments/runner/schedule/plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/runner/schedule/costs.h"
#include "experiments/runner/schedule/schedule.h"
#include "experiments/store/facts.h"
#include "experiments/study/series_rules.h"

namespace irk {
namespace {

// Between ranks: both sides look for messages every millisecond.
constexpr double kHandOut = 2e-3;  // s

/// The runs of the study as they are in the rows.
class StoredRuns {
 public:
  StoredRuns(const Study& study, const store::RunKeys& keys, const store::Rows& rows)
      : study_(study),
        keys_(keys),
        rows_(rows),
        costs_(
            study, [&](std::size_t i) { return keys[i]; }, rows) {
    for (std::size_t i = 0; i < keys.size(); ++i) {
      if (!keys.isLeftOut(i)) series_.push_back(i);
    }
  }

  double seconds(int workers, double hand_out_s) {
    Schedule schedule(study_, series_,
                      {.costs = [this](std::size_t i) { return costs_.of(i); },
                       .stored = [](std::size_t, std::size_t) { return std::optional<RunFacts>(); }});
    return simulatedSeconds(
        std::move(schedule), [this](const Piece& piece) { return made(piece); }, workers, hand_out_s);
  }

 private:
  SimulatedRun made(const Piece& piece) {
    const bool planned = study_.series[piece.series].end == SeriesEnd::kAsymptotic;
    const auto facts = store::factsOf(rows_, *rows_.find(keys_[piece.series][piece.run]), planned);
    const auto costs = costs_.of(piece.series);
    // A run that was not made would have taken as long as the longest of its series.
    const bool was_made = costs[piece.run] > 0 || !ranTooLong(facts.outcome);
    return {facts, was_made ? costs[piece.run] : *std::max_element(costs.begin(), costs.end())};
  }

  const Study& study_;
  const store::RunKeys& keys_;
  const store::Rows& rows_;
  Costs costs_;
  std::vector<std::size_t> series_;
};

}  // namespace

Plan planOf(const Study& study, const store::RunKeys& keys, const store::Rows& rows, const std::vector<int>& workers) {
  StoredRuns runs(study, keys, rows);
  Plan plan{runs.seconds(1, 0), {}};
  for (const int count : workers) {
    const double seconds = runs.seconds(count, kHandOut);
    plan.workers.push_back({count, seconds, plan.seconds / (count * seconds)});
  }
  return plan;
}

std::string textOf(const Plan& plan) {
  auto text = fmt::format("  plan on paper, from the times of the runs: {:.0f} s on one core", plan.seconds);
  for (const auto& [count, seconds, efficiency] : plan.workers) {
    text += fmt::format(", {:.1f} s on {} (efficiency {:.2f})", seconds, count, efficiency);
  }
  return text + '\n';
}

}  // namespace irk
