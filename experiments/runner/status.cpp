#include "experiments/runner/status.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_set>

#include "experiments/base/progress.h"
#include "experiments/base/time_left.h"
#include "experiments/runner/over_time.h"
#include "experiments/runner/timing.h"
#include "experiments/runs/run_table.h"
#include "experiments/store/facts.h"
#include "experiments/study/series_walk.h"

namespace irk {
namespace {

/// Goes through all series and counts their runs.
class Counting {
 public:
  Counting(const Study& study, const store::Store& store) : study_(study), store_(store) {
    if (study.timing.wanted) earlier_ = earlierEnds(study);
  }

  void count(const Series& series, const std::vector<std::uint64_t>& keys) {
    const bool planned = series.end == SeriesEnd::kAsymptotic;
    const store::Rows& runs = store_.runs();
    const SeriesState state = stateOf(series, [&](std::size_t run) -> std::optional<RunFacts> {
      const auto entry = runs.find(keys[run]);
      if (!entry) return {};
      return store::factsOf(runs, *entry, planned);
    });
    RunCounts counts;
    counts.planned = state.found.size() + state.missing.size() + state.unplanned;
    for (const std::size_t run : state.found) countFinished(series, run, keys[run], counts);
    for (const std::size_t run : state.missing) expect(kindOf(series.runs[run], series.end), 1);
    expect(kindOf(series.runs.front(), series.end), state.unplanned);
    part(series.block.empty() ? series.runs.front().scene : series.block).add(counts);
    if (series.block.empty()) status_.part = "scene";
    status_.all.add(counts);
  }

  StudyStatus result() {
    status_.guessed = time_.guessed();
    status_.seconds_left = time_.left();
    if (time_.spent() == 0) status_.seconds_left = std::nan("");
    if (status_.all.planned == status_.all.finished) status_.seconds_left = 0;
    return std::move(status_);
  }

 private:
  void expect(const std::string& kind, std::size_t runs) {
    if (runs == 0) return;
    time_.expect(kind, runs);
  }

  void countFinished(const Series& series, std::size_t run, std::uint64_t key, RunCounts& counts) {
    const store::Rows& runs = store_.runs();
    const store::Entry entry = *runs.find(key);
    const bool stale = !runs.isCurrent(entry), success = runs.name(entry.outcome) == name(Outcome::kSuccess);
    ++counts.finished;
    if (!success) ++counts.failed;
    if (stale) ++counts.stale;
    if (!store_.timedHere(entry)) ++counts.foreign;
    const double seconds = numberAt(names_, runs.row(entry), "cpu_s");
    if (!std::isnan(seconds)) {
      const std::string kind = kindOf(series.runs[run], series.end);
      time_.expect(kind, 1);
      time_.made(kind, seconds);
    }
    const TimingOptions& timing = study_.timing;
    if (!timing.wanted || !success || stale || earlier_.contains(key)) return;
    const std::size_t repetitions = repetitionsFor(timing, seconds);
    if (entry.repetitions >= repetitions) return;
    ++status_.to_time;
    const auto missing = static_cast<double>(repetitions - entry.repetitions);
    status_.timing_seconds_left += missing * std::max(seconds, timing.min_time_s);
  }

  RunCounts& part(const std::string& id) {
    const auto at =
        std::find_if(status_.parts.begin(), status_.parts.end(), [&](const auto& s) { return s.first == id; });
    if (at != status_.parts.end()) return at->second;
    return status_.parts.emplace_back(id, RunCounts()).second;
  }

  const Study& study_;
  const store::Store& store_;
  const Table names_{{}, runColumns(), {}};
  StudyStatus status_;
  TimeLeft time_;
  std::unordered_set<std::uint64_t> earlier_;
};

}  // namespace

void RunCounts::add(const RunCounts& other) {
  planned += other.planned;
  finished += other.finished;
  failed += other.failed;
  stale += other.stale;
  foreign += other.foreign;
}

StudyStatus statusOf(const Study& study, const RunnerOptions& options, const store::Store& store) {
  const RunKeys keys = runKeys(study, options);
  Counting counting(study, store);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (!keys.isLeftOut(i)) counting.count(study.series[i], keys[i]);
  }
  return counting.result();
}

std::string textOf(const StudyStatus& status) {
  std::size_t width = 5;
  for (const auto& [part, counts] : status.parts) width = std::max(width, part.size());
  std::string text = fmt::format("  {:<{}} {:>8} {:>8} {:>8} {:>8} {:>8}\n", status.part, width, "planned", "finished",
                                 "failed", "stale", "foreign");
  const auto line = [&](const std::string& part, const RunCounts& c) {
    text += fmt::format("  {:<{}} {:>8} {:>8} {:>8} {:>8} {:>8}\n", part, width, c.planned, c.finished, c.failed,
                        c.stale, c.foreign);
  };
  for (const auto& [part, counts] : status.parts) line(part, counts);
  line("all", status.all);
  const std::size_t missing = status.all.planned - status.all.finished;
  if (missing == 0) {
    text += "  all runs are finished\n";
  } else if (std::isnan(status.seconds_left)) {
    text += fmt::format("  {} runs to make; the time needed is unknown, as none has been made\n", missing);
  } else {
    text += fmt::format("  {} runs to make, about {} on one thread", missing, durationText(status.seconds_left));
    if (status.guessed > 0) text += fmt::format("; {} of them resemble no finished run", status.guessed);
    text += '\n';
  }
  if (status.to_time > 0) {
    text += fmt::format("  {} runs to time, about {}\n", status.to_time, durationText(status.timing_seconds_left));
  }
  return text;
}

}  // namespace irk
