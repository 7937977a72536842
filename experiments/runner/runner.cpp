#include "experiments/runner/runner.h"

#include <fmt/format.h>
#include <fmt/ostream.h>
#include <omp.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <numeric>
#include <optional>
#include <ostream>
#include <utility>
#include <vector>

#include "core/base/parallel_loop.h"
#include "experiments/base/clock.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/numbers.h"
#include "experiments/base/progress.h"
#include "experiments/reference/library.h"
#include "experiments/runner/costs.h"
#include "experiments/runner/shard_plan.h"
#include "experiments/runs/final_states.h"
#include "experiments/runs/run_table.h"
#include "experiments/solution/trajectory.h"
#include "experiments/store/facts.h"
#include "experiments/study/series_rules.h"
#include "experiments/study/series_walk.h"
#include "irk/misuse.h"

namespace irk {
namespace {

// Calls f(i) on several threads for every i of the queue. After an exception all threads stop.
template <class F>
void inParallel(WorkQueue& queue, int threads, F&& f) {
  std::atomic<std::size_t> turns = 0;
  ParallelLoop loop;
#pragma omp parallel num_threads(threads)
  for (bool more = true; more;) {
    loop.turn(turns++, [&] {
      const auto i = queue.next();
      if (i) f(*i);
      more = i.has_value();
    });
    more = more && !loop.hasThrown();
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
    lookForRows(out);
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
    // Long series first, so that all threads end at about the same time.
    const auto costs = ranks.rank() == 0 && is_any_missing_
                           ? expectedCosts(
                                 study_, [this](std::size_t i) { return keys_[i]; }, store_.runs())
                           : std::vector<double>(study_.series.size());
    std::stable_sort(work_.begin(), work_.end(), [&](std::size_t a, std::size_t b) { return costs[a] > costs[b]; });
    const auto queue = ranks.queue(work_, [this](std::size_t i) { countAsGiven(i); });
    inParallel(*queue, threads, [this](std::size_t i) { runSeries(i); });
  }

  RunKeys takeKeys() { return std::move(keys_); }

 private:
  // Notes whether runs are missing, and tells how many are stale.
  void lookForRows(std::ostream& out) {
    std::size_t stale = 0;
    keys_.forEach([&](std::uint64_t key, const std::string&) {
      const auto entry = store_.finished(key);
      if (!entry) is_any_missing_ = true;
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
    const auto keys = keys_[index];
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
      const auto facts = finishedOrMade(spec, keys[*run], kind, planned, tooLongRow(keys, walk));
      if (!facts) return;
      walk.record(*run, *facts);
    }
    const std::string kind = kindOf(series.runs.front(), series.end);
    const std::lock_guard lock(mutex_);
    for (; expected > 0; --expected) progress_->skipped(kind);
  }

  std::optional<TableRow> tooLongRow(const std::vector<std::uint64_t>& keys, const SeriesWalk& walk) {
    const auto run = walk.tooLong();
    if (!run) return {};
    const std::lock_guard lock(mutex_);
    const store::Rows& runs = store_.runs();
    return runs.row(*runs.find(keys[*run]));
  }

  // nullopt after an interrupt.
  std::optional<RunFacts> finishedOrMade(const RunSpec& spec, std::uint64_t key, const std::string& kind, bool planned,
                                         const std::optional<TableRow>& too_long) {
    if (interruptFlag()) return {};
    {
      const std::lock_guard lock(mutex_);
      const auto entry = store_.finished(key);
      if (entry && hasSolution(key, spec)) {
        progress_->skipped(kind);
        return store::factsOf(store_.runs(), *entry, planned);
      }
    }
    const double start = wallSeconds();
    const RunRecord record = too_long ? notMade(spec, *too_long, columns_) : make(spec);
    if (record.outcome == name(Outcome::kInterrupted)) return {};
    // The interrupt may have stopped the computation of its reference: the row would lack an error.
    if (interruptFlag() && spec.reference == ReferenceUse::kAuto) return {};
    const std::string text = hexText(key);
    const std::lock_guard lock(mutex_);
    if (study_.states) store_.addState(text, vectorText(componentsOf(record)), vectorText(barsOf(record)));
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
  RunKeys keys_;
  const Table columns_{{}, runColumns(), {}};
  std::vector<std::size_t> work_;    // indices of series with missing runs
  std::vector<std::size_t> asking_;  // those of work_ whose runs may need a computed reference
  bool is_any_missing_ = false;
  std::mutex mutex_;
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
  const auto shard = shardsOf(study, options);
  std::vector<RunKeys::Series> wanted;
  for (std::size_t i = 0; i < shard.size(); ++i) {
    const Series& series = study.series[i];
    wanted.push_back({shard[i] == options.shard.index ? series.runs.size() : 0, series.block});
  }
  RunKeys keys(wanted);
  std::vector<std::size_t> all(shard.size());
  std::iota(all.begin(), all.end(), 0);
  inParallel(*aloneRank()->queue(std::move(all), {}), threadCount(options.jobs), [&](std::size_t i) {
    if (!keys.isLeftOut(i)) keys.set(i, keysOf(study.series[i]));
  });
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

Table runStudy(const Study& study, const RunnerOptions& options, std::ostream& progress) {
  store::Store store(studyFolder(study, options), study.id, store::Use::kWrite, options.store, progress);
  const auto alone = aloneRank();
  const auto keys = makeRuns(study, options, store, *alone, progress);
  store.exportTables(keys, progress);
  return readTable(store.folder() / "runs.csv");
}

}  // namespace irk
