#include "experiments/runner/timing.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <unordered_set>
#include <vector>

#include "experiments/base/clock.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/numbers.h"
#include "experiments/base/progress.h"
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

/// The timing pass of one process. It keeps no table: every round reads the rows again.
class Pass {
 public:
  Pass(const Study& study, const RunKeys& keys, store::Store& store, TimingShare share, const TimeCall& time_call)
      : study_(study), keys_(keys), store_(store), share_(share), time_call_(time_call), earlier_(earlierEnds(study)) {}

  void expect(Progress& progress) const {
    forEachSeries([&](const Series& series, const std::vector<std::uint64_t>& keys) {
      for (std::size_t run = 0; run < series.runs.size(); ++run) {
        const auto candidate = candidateOf(keys[run]);
        if (!candidate) continue;
        for (auto i = candidate->measured.size(); i < candidate->wanted; ++i) progress.expect(kindOf(*candidate));
      }
    });
  }

  void measure(std::size_t round, Progress& progress) {
    forEachSeries([&](const Series& series, const std::vector<std::uint64_t>& keys) {
      for (std::size_t run = 0; run < series.runs.size() && !interruptFlag(); ++run) {
        auto candidate = candidateOf(keys[run]);
        if (!candidate || round < candidate->measured.size() || round >= candidate->wanted) continue;
        const double start = wallSeconds();
        const std::string kind = kindOf(*candidate);
        calibrate();
        time(series.runs[run], *candidate);
        store_.addTimes(candidate->row);
        progress.finished(kind, wallSeconds() - start);
        const auto wanted = repetitionsFor(study_.timing, leastOf(candidate->measured));
        for (auto i = candidate->wanted; i < wanted; ++i) progress.expect(kind);
      }
    });
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

  void time(RunSpec spec, Candidate& candidate) const {
    const double min_time_s = study_.timing.min_time_s;
    spec.time_limit = 0;
    const auto run = prepare(spec);
    // Warm up long runs, which are not repeated within the measurement: the first call touches new memory.
    if (candidate.wanted > 1 && candidate.seconds > min_time_s) run->wholeCall();
    const auto measure = [&] { candidate.measured.push_back(time_call_([&] { run->wholeCall(); }, min_time_s)); };
    measure();
    // The stored row does not tell that its first measurement is longer than the accuracy run.
    const bool ends_repetitions = repetitionsFor(study_.timing, candidate.measured.front()) < candidate.wanted;
    if (candidate.measured.size() == 1 && ends_repetitions) measure();
    const double setup = time_call_([&] { run->setUp(); }, kSetUpPart * min_time_s);
    Timing timing = timingOf(candidate.measured);
    timing.setup_s = std::fmin(candidate.setup_s, setup);
    setTiming(names_, candidate.row, timing);
  }

  void calibrate() {
    if (wallSeconds() < calibrated_ + kCalibrationPeriod) return;
    store_.addCalibration(store::calibrationSeconds());
    calibrated_ = wallSeconds();
  }

  const Study& study_;
  const RunKeys& keys_;
  store::Store& store_;
  TimingShare share_;
  const TimeCall& time_call_;
  const std::unordered_set<std::uint64_t> earlier_;
  const Table names_{{}, runColumns(), {}};
  double calibrated_ = -kCalibrationPeriod;
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
  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector);
  benchmark::ClearRegisteredBenchmarks();
  return collector.seconds;
}

std::size_t repetitionsFor(const TimingOptions& timing, double least_s) {
  if (least_s > timing.skip_above_s) return 0;
  return static_cast<std::size_t>(least_s > timing.once_above_s ? 1 : timing.repetitions);
}

void timeStudy(const Study& study, const RunKeys& keys, store::Store& store, TimingShare share, std::ostream& out,
               const TimeCall& time_call) {
  Progress progress(out, study.id + " timing");
  Pass pass(study, keys, store, share, time_call);
  pass.expect(progress);
  for (int round = 0; round < study.timing.repetitions; ++round)
    pass.measure(static_cast<std::size_t>(round), progress);
}

}  // namespace irk
