#include "experiments/runner/schedule/schedule.h"

#include <algorithm>
#include <tuple>

namespace irk {

Schedule::Schedule(const Study& study, const std::vector<std::size_t>& series, Sources sources)
    : study_(study), sources_(std::move(sources)) {
  for (const std::size_t i : series) {
    unopened_.emplace_back(-OpenSeries::largestUrgency(study.series[i], sources_.costs(i)), i);
  }
  std::sort(unopened_.begin(), unopened_.end(), std::greater<>());
}

bool Schedule::opensNext() const {
  return !unopened_.empty() && (ready_.empty() || unopened_.back().first <= ready_.begin()->first);
}

void Schedule::open() {
  const std::size_t series = unopened_.back().second;
  unopened_.pop_back();
  open_.try_emplace(series, study_.series[series], sources_.costs(series));
  update(series);
}

// After a change of the series.
void Schedule::update(std::size_t series) {
  Begun& begun = open_.at(series);
  if (begun.urgency) ready_.erase({-*begun.urgency, series});
  begun.urgency.reset();
  if (begun.runs.isOver()) {
    open_.erase(series);
    sources_.ended(series);
  } else if (begun.runs.next()) {
    begun.urgency = begun.runs.urgency();
    ready_.emplace(-*begun.urgency, series);
  }
}

std::optional<Piece> Schedule::next() {
  while (true) {
    while (opensNext()) open();
    if (ready_.empty()) return {};
    const std::size_t series = ready_.begin()->second;
    OpenSeries& runs = open_.at(series).runs;
    const std::size_t run = *runs.next();
    runs.give();
    const auto facts = sources_.stored(series, run);
    if (facts) runs.record(run, *facts);
    auto cancelled = runs.cancelled(run);
    update(series);
    if (!facts) return Piece{series, run, std::move(cancelled)};
  }
}

void Schedule::record(const Piece& piece, const RunFacts& facts) {
  const auto begun = open_.find(piece.series);
  if (begun == open_.end()) return;  // a cancelled run
  begun->second.runs.record(piece.run, facts);
  update(piece.series);
}

}  // namespace irk
