#include "experiments/runner/runner.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <omp.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <ostream>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/base/parallel_loop.h"
#include "experiments/base/clock.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/numbers.h"
#include "experiments/base/progress.h"
#include "experiments/reference/library.h"
#include "experiments/runner/schedule/costs.h"
#include "experiments/runner/series_keys.h"
#include "experiments/runner/shards.h"
#include "experiments/runs/final_states.h"
#include "experiments/runs/run_table.h"
#include "experiments/solution/trajectory.h"
#include "experiments/store/facts.h"
#include "experiments/study/series_rules.h"
#include "irk/misuse.h"

namespace irk {
namespace {

// Calls `work` on several threads. After an exception `stop` is called, and the first exception is rethrown.
template <class Work, class Stop>
void onThreads(int threads, Work&& work, Stop&& stop) {
  ParallelLoop loop;
#pragma omp parallel for num_threads(threads) schedule(static, 1)
  for (int i = 0; i < threads; ++i) {
    loop.turn(static_cast<std::size_t>(i), work);
    if (loop.hasThrown()) stop();
  }
  loop.rethrow();
}

bool asksForReference(const Series& series) { return series.runs.front().reference == ReferenceUse::kAuto; }

/// The state that the threads of one sweep share.
class Sweep {
 public:
  Sweep(const Study& study, const RunnerOptions& options, store::Store& store, std::ostream& out)
      : study_(study),
        store_(store),
        keys_(runKeys(study, options)),
        references_({.jobs = threadCount(options.jobs),
                     .stop = &interruptFlag(),
                     .tell = [this](const std::string& line) { told_.push_back(line); }}) {
    tellStaleRows(out);
    progress_.emplace(out, study.id);
    for (std::size_t i = 0; i < study.series.size(); ++i) {
      if (keys_.isLeftOut(i)) continue;
      const auto its = keys_[i];
      if (areFinished(its)) {
        progress_->stored(its.size());
      } else {
        work_.push_back(i);
      }
    }
    for (const std::size_t i : work_) {
      const Series& series = study.series[i];
      if (asksForReference(series)) asking_.push_back(i);
      const std::size_t expected = expectedRuns(series);
      for (std::size_t run = 0; run < expected; ++run) progress_->expect(kindOf(series.runs[run], series.end));
    }
  }

  /// Makes the references that the missing runs need. Ranks read from the cache what the first one has made.
  void makeReferences(Ranks& ranks, std::ostream& out) {
    constexpr std::size_t kAtOnce = 10'000;  // specs
    std::vector<RunSpec> missing;
    std::optional<Progress> progress(std::in_place, out, study_.id + " references");
    const auto prepare = [&] {
      if (ranks.rank() == 0) references_.prepare(missing, &*progress);
      missing.clear();
    };
    for (const std::size_t i : asking_) {
      const Series& series = study_.series[i];
      const auto keys = keys_[i];
      for (std::size_t run = 0; run < keys.size(); ++run) {
        if (store_.finished(keys[run])) continue;
        for (auto& spec : atReferenceTimes(series.runs[run])) missing.push_back(std::move(spec));
      }
      if (missing.size() >= kAtOnce) prepare();
    }
    prepare();
    progress.reset();  // tells the sum
    for (const auto& line : told_) fmt::print(out, "{}\n", line);
    ranks.meet();
  }

  /// Throws the first exception of any thread.
  void run(int threads, Ranks& ranks) {
    const auto queue = ranks.queue([this] { return schedule(); }, [this](const Piece& piece) { countAsGiven(piece); });
    const auto work = [&] {
      while (const auto piece = queue->next()) makePiece(*piece, *queue);
    };
    onThreads(threads, work, [&] { queue->close(); });
  }

  RunKeys takeKeys() { return std::move(keys_); }

 private:
  void tellStaleRows(std::ostream& out) const {
    std::size_t stale = 0;
    keys_.forEach([&](std::uint64_t key, const std::string&) {
      const auto entry = store_.finished(key);
      if (entry && !store_.runs().isCurrent(*entry)) ++stale;
    });
    if (stale == 0) return;
    fmt::print(
        out,
        "{}: {} runs were made by other code than this program's (column code) and are kept; --stale remake makes "
        "them again\n",
        study_.id, stale);
  }

  // Whether all runs of a series are stored, so that it need not be made. Trajectories are named by specs.
  bool areFinished(const std::vector<std::uint64_t>& keys) const {
    if (study_.trajectories) return false;
    return std::all_of(keys.begin(), keys.end(), [this](std::uint64_t key) {
      return store_.finished(key) && (!study_.states || store_.hasState(key));
    });
  }

  // Called on rank 0 only.
  Schedule schedule() {
    costs_.emplace(
        study_, [this](std::size_t i) { return keys_[i]; }, store_.runs());
    return {study_,
            work_,
            {.costs = [this](std::size_t i) { return costsOf(i); },
             .stored = [this](std::size_t i, std::size_t run) { return stored(i, run); },
             .ended = [this](std::size_t i) { countAsEnded(i); }}};
  }

  std::vector<double> costsOf(std::size_t index) {
    const std::lock_guard lock(mutex_);
    const auto keys = keys_[index];
    auto costs = costs_->of(index);
    for (std::size_t run = 0; run < keys.size(); ++run) {
      if (store_.finished(keys[run])) costs[run] = 0;
    }
    return costs;
  }

  // Called once for each run that is about to be handed out.
  std::optional<RunFacts> stored(std::size_t index, std::size_t run) {
    const Series series = study_.series[index];
    const std::uint64_t key = keys_[index][run];
    const std::lock_guard lock(mutex_);
    announce(index, series, run);
    const auto entry = store_.finished(key);
    if (!entry || !hasSolution(key, series.runs[run])) return {};
    progress_->skipped(progressKind(series, run));
    return store::factsOf(store_.runs(), *entry, series.end == SeriesEnd::kAsymptotic);
  }

  static std::string progressKind(const Series& series, std::size_t run) {
    const bool planned = series.end == SeriesEnd::kAsymptotic;
    return kindOf(planned ? series.runs.front() : series.runs[run], series.end);
  }

  // Counts the run as one of the expected ones of its series, if there are any left, else as another one.
  void announce(std::size_t index, const Series& series, std::size_t run) {
    std::size_t& expected = expected_.try_emplace(index, expectedRuns(series)).first->second;
    if (expected > 0) {
      --expected;
    } else {
      progress_->expect(progressKind(series, run));
    }
  }

  // Another rank makes the run: count it as done.
  void countAsGiven(const Piece& piece) {
    const Series series = study_.series[piece.series];
    const std::lock_guard lock(mutex_);
    progress_->skipped(progressKind(series, piece.run));
  }

  // The other expected runs of the series are not made.
  void countAsEnded(std::size_t index) {
    const Series series = study_.series[index];
    const std::lock_guard lock(mutex_);
    for (auto left = expected_.extract(index).mapped(); left > 0; --left) {
      progress_->skipped(progressKind(series, series.runs.size() - left));
    }
  }

  void makePiece(const Piece& piece, WorkQueue& queue) {
    const Series series = study_.series[piece.series];
    const RunSpec spec = series.runs[piece.run];
    const std::string kind = progressKind(series, piece.run);
    const double start = wallSeconds();
    const RunRecord record = make(spec, piece.cancelled.get());
    // The interrupt may have stopped the computation of its reference: the row would lack an error.
    if (interruptFlag() && (isInterrupted(record) || spec.reference == ReferenceUse::kAuto)) return;
    {
      const std::lock_guard lock(mutex_);
      if (isInterrupted(record)) {
        progress_->skipped(kind);  // cancelled
      } else {
        store(record, hexText(keys_[piece.series][piece.run]));
        progress_->finished(kind, wallSeconds() - start);
      }
    }
    const RunErrors& errors = record.errors;
    queue.record(piece, {record.outcome, {errors.u, errors.v, errors.x, errors.z}});
  }

  static bool isInterrupted(const RunRecord& record) { return record.outcome == name(Outcome::kInterrupted); }

  void store(const RunRecord& record, const std::string& key) {
    if (study_.states) store_.addState(key, vectorText(componentsOf(record)), vectorText(barsOf(record)));
    store_.addRun(runRow(key, study_.id, record));
  }

  // Whether the files that the study keeps for a finished run, state and trajectory, exist.
  bool hasSolution(std::uint64_t key, const RunSpec& spec) const {
    if (study_.states && !store_.hasState(key)) return false;
    return !study_.trajectories || std::filesystem::exists(trajectoryPath(store_.folder(), spec));
  }

  RunRecord make(const RunSpec& spec, const std::atomic<bool>* cancelled) {
    Watch watch{&interruptFlag(), {}, {}, [this](const RunSpec& run) { return references_.of(run); }};
    watch.cancelled = cancelled;
    watch.invariants = true;
    return withoutMachine(asRow(spec, [&] {
      return study_.trajectories ? executeWithTrajectory(spec, watch, trajectoryPath(store_.folder(), spec))
                                 : execute(spec, watch);
    }));
  }

  const Study& study_;
  store::Store& store_;
  RunKeys keys_;
  std::vector<std::size_t> work_;    // indices of series with missing runs
  std::vector<std::size_t> asking_;  // those of work_ whose runs may need a computed reference
  std::mutex mutex_;                 // of the store and of what follows
  std::optional<Costs> costs_;
  std::unordered_map<std::size_t, std::size_t> expected_;  // of begun series: the announced runs that are not counted
  std::optional<Progress> progress_;
  std::vector<std::string> told_;  // messages about references, to be printed
  ReferenceLibrary references_;
};

}  // namespace

std::filesystem::path studyFolder(const Study& study, const RunnerOptions& options) {
  const auto folder = options.results / study.id;
  const Shard& shard = options.shard;
  return shard.count == 1 ? folder : folder / fmt::format("shard_{}_of_{}", shard.index, shard.count);
}

int threadCount(int jobs) { return jobs > 0 ? jobs : omp_get_num_procs(); }

RunKeys runKeys(const Study& study, const RunnerOptions& options) {
  const auto shard = shardsOf(study, options.shard.count);
  std::vector<RunKeys::Series> wanted;
  for (std::size_t i = 0; i < shard.size(); ++i) {
    const Series& series = study.series[i];
    wanted.push_back({shard[i] == options.shard.index ? series.runs.size() : 0, series.block});
  }
  RunKeys keys(wanted);
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < shard.size(); i = next++) {
      if (!keys.isLeftOut(i)) keys.set(i, keysOf(study.series[i]));
    }
  };
  onThreads(threadCount(options.jobs), work, [&] { next = shard.size(); });
  keys.finish();
  return keys;
}

RunKeys makeRuns(const Study& study, const RunnerOptions& options, store::Store& store, Ranks& ranks,
                 std::ostream& progress) {
  Sweep sweep(study, options, store, progress);
  sweep.makeReferences(ranks, progress);
  sweep.run(threadCount(options.jobs), ranks);
  return sweep.takeKeys();
}

}  // namespace irk
