#include "experiments/runner.h"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <exception>
#include <map>
#include <mutex>
#include <optional>
#include <ostream>

#include "core/misuse.h"
#include "experiments/clock.h"
#include "experiments/environment.h"
#include "experiments/final_states.h"
#include "experiments/interrupt.h"
#include "experiments/numbers.h"
#include "experiments/progress.h"
#include "experiments/run_table.h"
#include "experiments/series_rules.h"
#include "experiments/step_planner.h"
#include "experiments/trajectory.h"
#include "tableaus/catalogue.h"

namespace irk {
namespace {

// What tells how long a run lasts, but for its number of stages: series come in their order.
// Of planned series the steps to come are not known.
std::string kindOf(const RunSpec& spec, SeriesEnd end) {
  const auto& tolerances = spec.options.tolerances;
  const bool planned = end == SeriesEnd::kAsymptotic;
  return fmt::format("{} {} {} {} {:g} {:g}", spec.scene, settingsText(spec.settings),
                     idOf(spec.formulation), planned ? spec.method : "",
                     planned ? 0 : spec.options.step.h,
                     std::max(tolerances.rtol, tolerances.atol));
}

// A planned series has usually so many runs.
constexpr std::size_t kPlannedRuns = 11;

GroupErrors groupErrors(const Table& table, const TableRow& row) {
  return {numberAt(table, row, "error_u"), numberAt(table, row, "error_v"),
          numberAt(table, row, "error_x"), numberAt(table, row, "error_z")};
}

// Renames the file to one that is not there yet: runs.old.csv, runs.old2.csv, ...
std::filesystem::path setAside(const std::filesystem::path& file) {
  std::filesystem::path to;
  for (int i = 1; to.empty() || std::filesystem::exists(to); ++i) {
    to = file;
    to.replace_extension(fmt::format("old{}{}", i == 1 ? "" : std::to_string(i),
                                     file.extension().string()));
  }
  std::filesystem::rename(file, to);
  return to;
}

// The rows that a former run of the study left behind.
Table finishedRuns(const std::filesystem::path& file, const Study& study,
                   const RunnerOptions& options, std::ostream& out) {
  Table fresh{environmentHead(study.id, threadCount(options.jobs)), runColumns(), {}};
  if (options.finished == FinishedRuns::kRunAgain || !std::filesystem::exists(file)) return fresh;
  const Table found = readTable(file);
  if (found.columns != fresh.columns) {
    out << fmt::format("{}: written by another version, its runs are made again; the old table is kept as {}\n",
                       file.string(), setAside(file).filename().string());
    return fresh;
  }
  const auto commit = [](const Table& t) {
    const auto at = std::find_if(t.head.begin(), t.head.end(),
                                 [](const auto& entry) { return entry.first == "commit"; });
    return at == t.head.end() ? std::string() : at->second;
  };
  fresh.rows = sortedRuns(found, study).rows;
  if (commit(found) != commit(fresh) && !fresh.rows.empty()) {
    out << fmt::format("{}: {} runs of commit {} are kept; --fresh makes them again\n",
                       file.string(), fresh.rows.size(), commit(found));
  }
  return fresh;
}

/// What the threads of one sweep share.
class Sweep {
 public:
  Sweep(const Study& study, const RunnerOptions& options, std::ostream& out)
      : study_(study),
        folder_(studyFolder(study, options)),
        table_(finishedRuns(folder_ / "runs.csv", study, options, out)),
        writer_(folder_ / "runs.csv", table_) {
    for (std::size_t i = 0; i < study.series.size(); ++i) {
      const auto turn = static_cast<int>(i % static_cast<std::size_t>(options.shards));
      if (turn + 1 == options.shard) work_.push_back(&study.series[i]);
    }
    progress_.emplace(out, study.id);
    for (const auto* series : work_) {
      const auto& runs = series->runs;
      const bool planned = series->end == SeriesEnd::kAsymptotic;
      const std::size_t count = planned ? std::min(kPlannedRuns, runs.size()) : runs.size();
      for (std::size_t i = 0; i < count; ++i) progress_->expect(kindOf(runs[i], series->end));
    }
    for (const auto& row : table_.rows) finished_[row.front()] = row;
    if (study.states) {
      const bool fresh = options.finished == FinishedRuns::kRunAgain;
      states_.emplace(folder_ / "states.csv", table_.head, fresh);
    }
  }

  /// Throws the first exception of any thread.
  void run(int threads) {
    // Long ones first, so that no thread is left alone at the end: more stages cost more.
    const auto stages = [](const Series* series) {
      const RunSpec& spec = series->runs.front();
      return isFamily(spec.method) ? spec.max_stages : stagesInId(spec.method);
    };
    std::stable_sort(work_.begin(), work_.end(), [&](const Series* a, const Series* b) {
      return stages(a) > stages(b);
    });
    std::exception_ptr failure;
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
    for (std::size_t i = 0; i < work_.size(); ++i) {
      try {
        runSeries(*work_[i]);
      } catch (...) {
        const std::lock_guard lock(mutex_);
        if (!failure) failure = std::current_exception();
      }
    }
    if (failure) std::rethrow_exception(failure);
  }

  Table result() {
    progress_.reset();
    for (const auto& [key, row] : finished_) table_.rows.push_back(row);
    table_ = sortedRuns(table_, study_);
    writeTable(folder_ / "runs.csv", table_);
    return table_;
  }

 private:
  void runSeries(const Series& series) {
    if (series.end == SeriesEnd::kAsymptotic) return runPlanned(series);
    const TableRow* too_long = nullptr;
    for (const auto& spec : series.runs) {
      const TableRow* row = finishedOrMade(spec, kindOf(spec, series.end), too_long);
      if (!row) return;
      const auto& outcome = textAt(table_, *row, "outcome");
      if (series.end == SeriesEnd::kTooLong && ranTooLong(outcome)) too_long = row;
    }
  }

  void runPlanned(const Series& series) {
    std::vector<double> steps;
    for (const auto& run : series.runs) steps.push_back(run.options.step.h);
    StepPlanner planner(std::move(steps), epsilonOf(series.runs.front().scalar));
    const std::string kind = kindOf(series.runs.front(), series.end);
    std::size_t expected = std::min(kPlannedRuns, series.runs.size());
    while (const auto i = planner.next()) {
      if (expected == 0) {
        const std::lock_guard lock(mutex_);
        progress_->expect(kind);
      } else {
        --expected;
      }
      const TableRow* row = finishedOrMade(series.runs[*i], kind, nullptr);
      if (!row) return;
      const auto& outcome = textAt(table_, *row, "outcome");
      if (succeededAt(table_, *row)) {
        planner.record(*i, groupErrors(table_, *row));
      } else {
        planner.recordFailure(*i);
      }
      if (outcome == "refused" || ranTooLong(outcome)) planner.endProbe();
    }
    const std::lock_guard lock(mutex_);
    for (; expected > 0; --expected) progress_->skipped(kind);
  }

  // Null after an interrupt.
  const TableRow* finishedOrMade(const RunSpec& spec, const std::string& kind,
                                 const TableRow* too_long) {
    if (interruptFlag()) return nullptr;
    const std::string key = specKey(spec);
    {
      const std::lock_guard lock(mutex_);
      const auto found = finished_.find(key);
      if (found != finished_.end() && hasSolution(key, spec)) {
        progress_->skipped(kind);
        return &found->second;
      }
    }
    const double start = wallSeconds();
    const RunRecord record = too_long ? notMade(spec, *too_long, table_) : make(spec);
    if (record.outcome == name(Outcome::kInterrupted)) return nullptr;
    const std::lock_guard lock(mutex_);
    TableRow& row = finished_[key] = runRow(key, study_.id, record);
    writer_.append(row);
    if (states_) states_->append(key, record);
    if (too_long) {
      progress_->skipped(kind);
    } else {
      progress_->finished(kind, wallSeconds() - start);
    }
    return &row;
  }

  // What the study keeps of a finished run beside its row is there.
  bool hasSolution(const std::string& key, const RunSpec& spec) const {
    if (states_ && !states_->has(key)) return false;
    return !study_.trajectories || std::filesystem::exists(trajectoryPath(folder_, spec));
  }

  RunRecord make(const RunSpec& spec) const {
    const Watch watch{&interruptFlag(), {}, {}};
    return withoutMachine(orRefused(spec, [&] {
      return study_.trajectories ? executeWithTrajectory(spec, watch, trajectoryPath(folder_, spec))
                                 : execute(spec, watch);
    }));
  }

  const Study& study_;
  std::filesystem::path folder_;
  Table table_;
  RowWriter writer_;
  std::optional<FinalStates> states_;
  std::vector<const Series*> work_;
  std::mutex mutex_;
  std::optional<Progress> progress_;
  std::map<std::string, TableRow> finished_;  // by key; rows stay where they are
};

}  // namespace

void parseShard(std::string_view text, RunnerOptions& options) {
  const auto slash = text.find('/');
  if (slash == std::string_view::npos) {
    throw Misuse(fmt::format("shard = '{}' is not of the form i/n", text));
  }
  constexpr int kMostShards = 1'000'000;
  options.shards = static_cast<int>(parseInteger("shard", text.substr(slash + 1), 1, kMostShards));
  options.shard = static_cast<int>(parseInteger("shard", text.substr(0, slash), 1, options.shards));
}

std::filesystem::path studyFolder(const Study& study, const RunnerOptions& options) {
  const auto folder = options.results / study.id;
  if (options.shards == 1) return folder;
  return folder / fmt::format("shard_{}_of_{}", options.shard, options.shards);
}

int threadCount(int jobs) { return jobs > 0 ? jobs : omp_get_num_procs(); }

Table runStudy(const Study& study, const RunnerOptions& options, std::ostream& progress) {
  Sweep sweep(study, options, progress);
  sweep.run(threadCount(options.jobs));
  return sweep.result();
}

Table sortedRuns(const Table& runs, const Study& study) {
  std::map<std::string_view, const TableRow*> by_key;
  for (const auto& row : runs.rows) by_key[row.front()] = &row;
  Table sorted{runs.head, runs.columns, {}};
  for (const auto* all : {&study.series, &study.other_variant}) {
    for (const auto& series : *all) {
      for (const auto& spec : series.runs) {
        const auto found = by_key.find(specKey(spec));
        if (found == by_key.end()) continue;
        sorted.rows.push_back(*found->second);
        by_key.erase(found);
      }
    }
  }
  return sorted;
}

}  // namespace irk
