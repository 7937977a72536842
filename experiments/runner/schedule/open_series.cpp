#include "experiments/runner/schedule/open_series.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "experiments/study/series_rules.h"

namespace irk {
namespace {

// The urgency of a run that may turn out not to count, by that of one that counts. By the times of `robustness` in full
// (2070 runs, AMD EPYC), the efficiency of 16 workers that guess the costs is 0.81, 0.79 and 0.70 with 0.1, 0.25 and 1:
// more runs are made in vain while others wait. That of 64 workers that know them is 0.62, 0.75 and 0.89: long series
// end earlier.
constexpr double kUncertain = 0.25;

double sum(const std::vector<double>& costs) { return std::accumulate(costs.begin(), costs.end(), 0.0); }

}  // namespace

OpenSeries::OpenSeries(Series series, std::vector<double> costs)
    : series_(std::move(series)),
      costs_(std::move(costs)),
      cost_left_(sum(costs_)),
      states_(costs_.size(), State::kWaiting),
      limit_(costs_.size()),
      cancelled_(series_.end == SeriesEnd::kTooLong ? costs_.size() : 0) {
  if (series_.end == SeriesEnd::kAsymptotic) {
    walk_.emplace(series_);
    plan();
    return;
  }
  order_.resize(costs_.size());
  std::iota(order_.begin(), order_.end(), 0);
  if (series_.end == SeriesEnd::kTooLong) return;
  std::stable_sort(order_.begin(), order_.end(), [&](auto a, auto b) { return costs_[a] > costs_[b]; });
}

double OpenSeries::largestUrgency(const Series& series, const std::vector<double>& costs) {
  return series.end == SeriesEnd::kAll ? *std::max_element(costs.begin(), costs.end()) : sum(costs);
}

std::optional<std::size_t> OpenSeries::next() const {
  if (given_ == order_.size() || order_[given_] >= limit_) return {};
  return order_[given_];
}

double OpenSeries::urgency() const {
  const std::size_t run = *next();
  if (series_.end == SeriesEnd::kAll) return costs_[run];
  return isCertain(run) ? cost_left_ : kUncertain * cost_left_;
}

// Whether a serial walk makes the run: of each two runs in a row before it, one is known not to have taken too long.
bool OpenSeries::isCertain(std::size_t run) const {
  if (series_.end != SeriesEnd::kTooLong) return true;
  for (std::size_t second = 1; second < run; ++second) {
    if (states_[second - 1] != State::kFine && states_[second] != State::kFine) return false;
  }
  return true;
}

void OpenSeries::give() {
  const std::size_t run = order_[given_];
  if (!isCertain(run)) cancelled_[run] = std::make_shared<std::atomic<bool>>(false);
  states_[run] = State::kGiven;
  cost_left_ -= costs_[run];
  ++given_;
  ++under_way_;
  plan();
}

void OpenSeries::record(std::size_t run, const RunFacts& facts) {
  --under_way_;
  states_[run] = ranTooLong(facts.outcome) ? State::kTooLong : State::kFine;
  if (walk_) walk_->record(run, facts);
  if (series_.end == SeriesEnd::kTooLong) cancel();
  plan();
}

// Appends the runs that the planner has decided on.
void OpenSeries::plan() {
  if (!walk_) return;
  while (!walk_->needsLast() || (under_way_ == 0 && given_ == order_.size())) {
    const auto run = walk_->next();
    if (!run) return;
    order_.push_back(*run);
  }
}

// Runs behind two in a row that took too long do not count, whatever the runs before them will be.
void OpenSeries::cancel() {
  for (std::size_t second = 1; second < limit_; ++second) {
    if (states_[second - 1] == State::kTooLong && states_[second] == State::kTooLong) limit_ = second + 1;
  }
  for (std::size_t run = limit_; run < cancelled_.size(); ++run) {
    if (cancelled_[run]) *cancelled_[run] = true;
  }
}

bool OpenSeries::isOver() const {
  if (next()) return false;
  if (series_.end != SeriesEnd::kTooLong) return under_way_ == 0;
  return std::none_of(states_.begin(), states_.begin() + static_cast<std::ptrdiff_t>(limit_),
                      [](State state) { return state == State::kWaiting || state == State::kGiven; });
}

std::shared_ptr<const std::atomic<bool>> OpenSeries::cancelled(std::size_t run) const {
  return cancelled_.empty() ? nullptr : cancelled_[run];
}

}  // namespace irk
