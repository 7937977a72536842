#include "experiments/runner/runner.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <omp.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <ostream>
#include <unordered_set>

#include "experiments/base/clock.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/numbers.h"
#include "experiments/base/progress.h"
#include "experiments/reference/library.h"
#include "experiments/runs/final_states.h"
#include "experiments/runs/run_table.h"
#include "experiments/solution/trajectory.h"
#include "experiments/store/facts.h"
#include "experiments/study/series_rules.h"
#include "experiments/study/series_walk.h"
#include "irk/misuse.h"
#include "irk/tableaus.h"

namespace irk {
namespace {

// Calls f(i) on several threads for every i of the queue. After an exception all threads stop, and the first
// exception is rethrown.
template <class F>
void inParallel(WorkQueue& queue, int threads, F&& f) {
  std::mutex mutex;
  std::exception_ptr failure;
  std::atomic<bool> failed = false;
#pragma omp parallel num_threads(threads)
  {
    try {
      while (!failed) {
        const auto i = queue.next();
        if (!i) break;
        f(*i);
      }
    } catch (...) {
      failed = true;
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
}

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
    for (std::size_t i = 0; i < study.series.size(); ++i) {
      if (!keys_[i].empty()) work_.push_back(i);
    }
    tellStale(out);
    progress_.emplace(out, study.id);
    for (const std::size_t i : work_) {
      const Series& series = study.series[i];
      const std::size_t expected = expectedRuns(series);
      for (std::size_t run = 0; run < expected; ++run) progress_->expect(kindOf(series.runs[run], series.end));
    }
  }

  /// Makes the references that the missing runs need. Ranks read from the cache what the first one has made.
  void makeReferences(Ranks& ranks, std::ostream& out) {
    const auto asks = [](const Series& series) { return series.runs.front().reference == ReferenceUse::kAuto; };
    if (std::none_of(study_.series.begin(), study_.series.end(), asks)) return;
    std::vector<RunSpec> missing;
    for (const std::size_t i : work_) {
      if (!asks(study_.series[i])) continue;
      for (std::size_t run = 0; run < keys_[i].size(); ++run) {
        if (store_.finished(keys_[i][run])) continue;
        for (auto& spec : atReferenceTimes(study_.series[i].runs[run])) missing.push_back(std::move(spec));
      }
    }
    if (ranks.rank() == 0) references_.prepare(missing, study_.id + " references", out);
    for (const auto& line : told_) fmt::print(out, "{}\n", line);
    ranks.meet();
  }

  /// Throws the first exception of any thread. All ranks must have the same work in the same order.
  void run(int threads, Ranks& ranks) {
    // Long series first, so that all threads end at about the same time; more stages cost more.
    const auto stages = [this](std::size_t series) {
      const RunSpec& spec = study_.series[series].runs.front();
      return isFamily(spec.method) ? spec.max_stages : stagesInId(spec.method);
    };
    std::stable_sort(work_.begin(), work_.end(), [&](std::size_t a, std::size_t b) { return stages(a) > stages(b); });
    const auto queue = ranks.queue(work_.size(), [this](std::size_t i) { countAsGiven(work_[i]); });
    inParallel(*queue, threads, [this](std::size_t i) { runSeries(work_[i]); });
  }

  const RunKeys& keys() const { return keys_; }

 private:
  void tellStale(std::ostream& out) const {
    std::size_t stale = 0;
    for (const std::size_t i : work_) {
      for (const auto key : keys_[i]) {
        const auto* entry = store_.finished(key);
        if (entry && !store_.runs().isCurrent(*entry)) ++stale;
      }
    }
    if (stale == 0) return;
    fmt::print(
        out,
        "{}: {} runs were made by other code than this program's (column code) and are kept; --stale remake makes "
        "them again\n",
        study_.id, stale);
  }

  // Another rank makes the series: count its runs as done.
  void countAsGiven(std::size_t index) {
    const Series& series = study_.series[index];
    const std::lock_guard lock(mutex_);
    const std::size_t expected = expectedRuns(series);
    for (std::size_t run = 0; run < expected; ++run) progress_->skipped(kindOf(series.runs[run], series.end));
  }

  void runSeries(std::size_t index) {
    const Series& series = study_.series[index];
    const bool planned = series.end == SeriesEnd::kAsymptotic;
    SeriesWalk walk(series);
    std::size_t expected = expectedRuns(series);
    while (const auto run = walk.next()) {
      const RunSpec& spec = series.runs[*run];
      const std::string kind = kindOf(planned ? series.runs.front() : spec, series.end);
      if (expected > 0) {
        --expected;
      } else {
        const std::lock_guard lock(mutex_);
        progress_->expect(kind);
      }
      const auto facts = finishedOrMade(spec, keys_[index][*run], kind, planned, tooLongRow(index, walk));
      if (!facts) return;
      walk.record(*run, *facts);
    }
    const std::string kind = kindOf(series.runs.front(), series.end);
    const std::lock_guard lock(mutex_);
    for (; expected > 0; --expected) progress_->skipped(kind);
  }

  std::optional<TableRow> tooLongRow(std::size_t index, const SeriesWalk& walk) {
    const auto run = walk.tooLong();
    if (!run) return {};
    const std::lock_guard lock(mutex_);
    const store::Rows& runs = store_.runs();
    return runs.row(*runs.find(keys_[index][*run]));
  }

  // nullopt after an interrupt.
  std::optional<RunFacts> finishedOrMade(const RunSpec& spec, std::uint64_t key, const std::string& kind, bool planned,
                                         const std::optional<TableRow>& too_long) {
    if (interruptFlag()) return {};
    {
      const std::lock_guard lock(mutex_);
      const store::Entry* entry = store_.finished(key);
      if (entry && hasSolution(key, spec)) {
        progress_->skipped(kind);
        return store::factsOf(store_.runs(), *entry, planned);
      }
    }
    const double start = wallSeconds();
    const RunRecord record = too_long ? notMade(spec, *too_long, columns_) : make(spec);
    if (record.outcome == name(Outcome::kInterrupted)) return {};
    // Its reference may have been interrupted: with it the run would have an error.
    if (interruptFlag() && spec.reference == ReferenceUse::kAuto) return {};
    const std::string text = hexText(key);
    const std::lock_guard lock(mutex_);
    if (study_.states) store_.addState(text, vectorText(componentsOf(record)));
    store_.addRun(runRow(text, study_.id, record));
    if (too_long) {
      progress_->skipped(kind);
    } else {
      progress_->finished(kind, wallSeconds() - start);
    }
    const RunErrors& errors = record.errors;
    return RunFacts{record.outcome, {errors.u, errors.v, errors.x, errors.z}};
  }

  // Whether the files that the study keeps for a finished run, state and trajectory, exist.
  bool hasSolution(std::uint64_t key, const RunSpec& spec) const {
    if (study_.states && !store_.hasState(key)) return false;
    return !study_.trajectories || std::filesystem::exists(trajectoryPath(store_.folder(), spec));
  }

  RunRecord make(const RunSpec& spec) {
    Watch watch{&interruptFlag(), {}, {}, [this](const RunSpec& run) { return references_.of(run); }};
    watch.invariants = true;
    return withoutMachine(orRefused(spec, [&] {
      return study_.trajectories ? executeWithTrajectory(spec, watch, trajectoryPath(store_.folder(), spec))
                                 : execute(spec, watch);
    }));
  }

  const Study& study_;
  store::Store& store_;
  const RunKeys keys_;
  const Table columns_{{}, runColumns(), {}};
  std::vector<std::size_t> work_;  // indices of series
  std::mutex mutex_;
  std::optional<Progress> progress_;
  std::vector<std::string> told_;  // about references
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
  RunKeys keys(study.series.size());
  const auto shard = shardOfSeries(study, options.shard.count);
  const auto all = aloneRank()->queue(keys.size(), {});
  inParallel(*all, threadCount(options.jobs), [&](std::size_t i) {
    if (shard[i] != options.shard.index) return;
    for (const auto& spec : study.series[i].runs) keys[i].push_back(store::keyNumber(specKey(spec)));
  });
  return keys;
}

std::vector<std::uint64_t> inOrder(const RunKeys& keys) {
  std::vector<std::uint64_t> order;
  std::unordered_set<std::uint64_t> there;
  for (const auto& series : keys) {
    for (const auto key : series) {
      if (there.insert(key).second) order.push_back(key);
    }
  }
  return order;
}

std::vector<std::uint64_t> makeRuns(const Study& study, const RunnerOptions& options, store::Store& store, Ranks& ranks,
                                    std::ostream& progress) {
  Sweep sweep(study, options, store, progress);
  sweep.makeReferences(ranks, progress);
  sweep.run(threadCount(options.jobs), ranks);
  return inOrder(sweep.keys());
}

Table runStudy(const Study& study, const RunnerOptions& options, std::ostream& progress) {
  store::Store store(studyFolder(study, options), study.id, store::Use::kWrite, options.store, progress);
  const auto alone = aloneRank();
  const auto keys = makeRuns(study, options, store, *alone, progress);
  store.nameBlocks(blocksOf(study, runKeys(study, options)));
  store.exportTables(keys);
  return readTable(store.folder() / "runs.csv");
}

}  // namespace irk
