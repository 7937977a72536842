#include "experiments/runner/timing.h"

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "experiments/base/clock.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/numbers.h"
#include "experiments/base/progress.h"
#include "experiments/runner/cores/at_once.h"
#include "experiments/runner/cores/children.h"
#include "experiments/runner/cores/processors.h"
#include "experiments/runner/over_time.h"
#include "experiments/store/calibration.h"

namespace irk {
namespace {

constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();
// Time spent on measuring the set-up, as a part of that for the whole call.
constexpr double kSetUpPart = 0.1;
constexpr double kCalibrationPeriod = 1;  // s

/// Stores the seconds per integration; prints nothing.
class Collector final : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const auto& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
      seconds = run.cpu_accumulated_time / static_cast<double>(run.iterations);
    }
  }
  double seconds = kNotMeasured;
};

/// A run whose times are missing.
struct Candidate {
  TableRow row;
  double seconds;  // of the accuracy run, on any machine
  std::size_t wanted;
  std::vector<double> measured;  // on this processor
  double setup_s;                // the least of them; NaN: not measured
};

double leastOf(const std::vector<double>& seconds) { return *std::min_element(seconds.begin(), seconds.end()); }

// Timing takes about the same time for runs of about the same length.
std::string kindOf(const Candidate& candidate) { return std::to_string(std::ilogb(candidate.seconds)); }

/// What is measured of a run in one round, as the numbers of a call (cores/children.h).
struct Measured {
  double calibration_s;         // NaN: not measured
  double setup_s;               // the set-up alone
  std::vector<double> whole_s;  // the whole call, once or twice

  std::vector<double> numbers() const {
    std::vector<double> all{calibration_s, setup_s};
    all.insert(all.end(), whole_s.begin(), whole_s.end());
    return all;
  }
  static Measured of(const std::vector<double>& numbers) {
    return {numbers[0], numbers[1], {numbers.begin() + 2, numbers.end()}};
  }
};

Measured measureRun(RunSpec spec, const Candidate& candidate, const TimingOptions& timing, bool calibrates,
                    const TimeCall& time_call) {
  Measured measured{calibrates ? store::calibrationSeconds() : kNotMeasured, kNotMeasured, {}};
  spec.time_limit = 0;
  const auto run = prepare(spec);
  // Warm up long runs, which are not repeated within the measurement: the first call touches new memory.
  if (candidate.wanted > 1 && candidate.seconds > timing.min_time_s) run->wholeCall();
  const auto measure = [&] { measured.whole_s.push_back(time_call([&] { run->wholeCall(); }, timing.min_time_s)); };
  measure();
  // The stored row does not tell that its first measurement is longer than the accuracy run.
  const bool first = candidate.measured.empty();
  if (first && repetitionsFor(timing, measured.whole_s.front()) < candidate.wanted) measure();
  measured.setup_s = time_call([&] { run->setUp(); }, kSetUpPart * timing.min_time_s);
  return measured;
}

/// The timing pass of one process. It keeps no table: every round reads the rows again.
class Pass {
 public:
  Pass(const Study& study, const RunKeys& keys, store::Store& store, TimingShare share, const TimeCall& time_call)
      : study_(study), keys_(keys), store_(store), share_(share), time_call_(time_call), earlier_(earlierEnds(study)) {}

  /// Returns the number of runs that are to be timed.
  std::size_t expect(Progress& progress) const {
    std::size_t runs = 0;
    forEachSeries([&](const Series& series, const std::vector<std::uint64_t>& keys) {
      for (std::size_t run = 0; run < series.runs.size(); ++run) {
        const auto candidate = candidateOf(keys[run]);
        if (!candidate) continue;
        ++runs;
        for (auto i = candidate->measured.size(); i < candidate->wanted; ++i) progress.expect(kindOf(*candidate));
      }
    });
    return runs;
  }

  /// Finds out, if need be, on how many cores `runs` are timed at once. Returns a line about it.
  std::string chooseCores(std::size_t runs) {
    cores::requireCores(share_.cores);
    const auto processors = cores::physicalCores();
    std::vector<store::CoresTrial> trials{
        {static_cast<std::size_t>(share_.cores), kNotMeasured, kNotMeasured, /*taken=*/true}};
    if (share_.cores == 0) {
      const auto measure = [&](std::size_t count) { return cores::measureOn(processors, count); };
      trials = cores::tryCores(std::min(runs, processors.size()), measure);
    }
    for (const auto& trial : trials) store_.addCores(trial);
    const std::size_t taken = cores::takenOf(trials);
    if (taken > 1) {
      benchmark::CPUInfo::Get();  // which is read once, here and not in each child
      children_.emplace(std::vector(processors.begin(), processors.begin() + static_cast<std::ptrdiff_t>(taken)));
    }
    return cores::textOf(trials, processors.size());
  }

  void measure(std::size_t round, Progress& progress) {
    forEachSeries([&](const Series& series, const std::vector<std::uint64_t>& keys) {
      for (std::size_t run = 0; run < series.runs.size() && !interruptFlag(); ++run) {
        const auto candidate = candidateOf(keys[run]);
        if (!candidate || round < candidate->measured.size() || round >= candidate->wanted) continue;
        // Another block may have the same run; one that failed may fail again.
        if (!taken_up_.insert(keys[run]).second) continue;
        begin(series.runs[run], keys[run], *candidate, progress);
      }
    });
    if (children_) children_->finish();
  }

  /// The number of runs that could not be measured, and why not the first one; empty if there are none.
  std::string failureText() const {
    if (failed_ == 0) return {};
    return fmt::format("{} could not be timed, the rows say why in the column detail; the first one: {}",
                       failed_ == 1 ? "1 run" : fmt::format("{} runs", failed_), first_failure_);
  }

 private:
  void forEachSeries(const std::function<void(const Series&, const std::vector<std::uint64_t>&)>& take) const {
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      if (i % share_.hosts == share_.host && !keys_.isLeftOut(i)) take(study_.series[i], keys_[i]);
    }
  }

  std::optional<Candidate> candidateOf(std::uint64_t key) const {
    const store::Rows& runs = store_.runs();
    const auto entry = runs.find(key);
    // Times of this code do not belong to the counters of stale rows.
    if (!entry || !runs.isCurrent(*entry) || runs.name(entry->outcome) != name(Outcome::kSuccess)) return {};
    const TimingOptions& timing = study_.timing;
    const bool counts = store_.options().times == store::Times::kAll || store_.timedHere(*entry);
    const std::size_t repetitions = counts ? entry->repetitions : 0;
    if (repetitions >= static_cast<std::size_t>(timing.repetitions) || earlier_.contains(key)) return {};
    Candidate candidate{runs.row(*entry), 0, 0, {}, kNotMeasured};
    candidate.seconds = numberAt(names_, candidate.row, "cpu_s");
    candidate.wanted = repetitionsFor(timing, candidate.seconds);
    if (repetitions >= candidate.wanted) return {};
    if (!store_.timedHere(*entry)) return candidate;
    std::istringstream in(textAt(names_, candidate.row, "cpu_all"));
    for (std::string word; in >> word;) candidate.measured.push_back(cellNumber(word));
    if (!candidate.measured.empty()) candidate.setup_s = numberAt(names_, candidate.row, "cpu_setup_s");
    return candidate;
  }

  // Measures the run, in a child process if there are any; then its row is stored.
  void begin(const RunSpec& spec, std::uint64_t key, const Candidate& candidate, Progress& progress) {
    const double start = wallSeconds();
    const bool calibrates = start >= calibrated_ + kCalibrationPeriod;
    if (calibrates) calibrated_ = start;
    const auto call = [this, spec, candidate, calibrates] {
      return measureRun(spec, candidate, study_.timing, calibrates, time_call_).numbers();
    };
    const auto done = [this, key, candidate, start, &progress](const cores::Answer& answer) {
      if (answer.failure.empty()) {
        take(candidate, Measured::of(answer.numbers), progress);
        taken_up_.erase(key);
      } else {
        takeFailure(candidate, answer.failure, progress);
      }
      progress.finished(kindOf(candidate), wallSeconds() - start);
    };
    if (children_ && spec.options.threads == 1) return children_->begin(call, done);
    if (children_) children_->finish();
    done(cores::answerOf(call));
  }

  void take(Candidate candidate, const Measured& measured, Progress& progress) {
    if (!std::isnan(measured.calibration_s)) store_.addCalibration(measured.calibration_s);
    auto& all = candidate.measured;
    all.insert(all.end(), measured.whole_s.begin(), measured.whole_s.end());
    Timing timing = timingOf(all);
    timing.setup_s = std::fmin(candidate.setup_s, measured.setup_s);
    setTiming(names_, candidate.row, timing);
    store_.addTimes(candidate.row);
    const auto wanted = repetitionsFor(study_.timing, leastOf(all));
    for (auto i = candidate.wanted; i < wanted; ++i) progress.expect(kindOf(candidate));
  }

  void takeFailure(Candidate candidate, const std::string& cause, Progress& progress) {
    if (failed_++ == 0) first_failure_ = cause;
    setNotTimed(names_, candidate.row, cause);
    store_.addTimes(candidate.row);
    for (auto i = candidate.measured.size() + 1; i < candidate.wanted; ++i) progress.skipped(kindOf(candidate));
  }

  const Study& study_;
  const RunKeys& keys_;
  store::Store& store_;
  TimingShare share_;
  const TimeCall& time_call_;
  const std::unordered_set<std::uint64_t> earlier_;
  const Table names_{{}, runColumns(), {}};
  double calibrated_ = -kCalibrationPeriod;
  std::unordered_set<std::uint64_t> taken_up_;  // runs that are being measured, and those that failed
  std::size_t failed_ = 0;
  std::string first_failure_;
  std::optional<cores::Children> children_;  // none: runs are measured in this process
};

}  // namespace

Timing timingOf(std::vector<double> seconds) {
  std::vector<double> sorted = seconds;
  std::sort(sorted.begin(), sorted.end());
  const double least = sorted.front();
  return {least, sorted[sorted.size() / 2], (sorted.back() - least) / least, std::move(seconds)};
}

double timeCall(const std::function<void()>& call, double min_time_s) {
  benchmark::RegisterBenchmark("call", [&call](benchmark::State& state) {
    for ([[maybe_unused]] auto _ : state) call();
  })->MinTime(min_time_s);
  struct Cleared {
    ~Cleared() { benchmark::ClearRegisteredBenchmarks(); }
  } const cleared;  // also if the call throws
  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector);
  return collector.seconds;
}

std::optional<TimingShare> timingShare(Ranks& ranks, const RunnerOptions& options) {
  const auto all = timingRanks(ranks.hosts());
  const auto own = std::find(all.begin(), all.end(), ranks.rank());
  if (own == all.end()) return {};
  return TimingShare{static_cast<std::size_t>(own - all.begin()), all.size(), options.timing_cores};
}

std::size_t repetitionsFor(const TimingOptions& timing, double least_s) {
  if (least_s > timing.skip_above_s) return 0;
  return static_cast<std::size_t>(least_s > timing.once_above_s ? 1 : timing.repetitions);
}

void timeStudy(const Study& study, const RunKeys& keys, store::Store& store, TimingShare share, std::ostream& out,
               const TimeCall& time_call) {
  const auto tell = [&](const std::string& text) {
    if (!text.empty()) fmt::print(out, "{} timing: {}\n", study.id, text);
  };
  Pass pass(study, keys, store, share, time_call);
  {
    Progress progress(out, study.id + " timing");
    const std::size_t runs = pass.expect(progress);
    if (runs == 0) return;
    tell(pass.chooseCores(runs));
    for (int round = 0; round < study.timing.repetitions; ++round)
      pass.measure(static_cast<std::size_t>(round), progress);
  }
  tell(pass.failureText());
}

}  // namespace irk
