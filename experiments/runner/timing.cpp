#include "experiments/runner/timing.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/base/clock.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/numbers.h"
#include "experiments/base/progress.h"
#include "experiments/runner/over_time.h"
#include "experiments/runner/runner.h"
#include "experiments/tables/build_info.h"
#include "experiments/tables/environment.h"

namespace irk {
namespace {

constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();
// The set-up is measured for this part of the time that the whole call is.
constexpr double kSetUpPart = 0.1;

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

struct Candidate {
  TableRow* row;
  RunSpec spec;
  double seconds;  // of the accuracy run, on any machine
  int repetitions;
  std::vector<double> measured;  // starts with the measurements of an interrupted pass
  double setup_s;                // the least of them; NaN: not measured
};

// Timing takes about the same time for runs of about the same length.
std::string kindOf(const Candidate& candidate) { return std::to_string(std::ilogb(candidate.seconds)); }

// The row's repetitions that were measured on this processor; empty if its times are not valid (forgetTiming).
std::vector<double> measuredHere(const store::Store& store, const Table& runs, const TableRow& row) {
  if (store.processor(textAt(runs, row, "cpu_environment")) != processorName()) return {};
  std::vector<double> seconds;
  std::istringstream in(textAt(runs, row, "cpu_all"));
  for (std::string word; in >> word;) seconds.push_back(cellNumber(word));
  return seconds;
}

// The run's length, even if it was measured elsewhere and is not valid as a time.
double lengthOf(const store::Store& store, const Table& runs, const TableRow& row) {
  const double seconds = numberAt(runs, row, "cpu_s");
  const auto* entry = store.runs().find(store::keyNumber(row.front()));
  if (!std::isnan(seconds) || !entry) return seconds;
  return numberAt(runs, store.runs().row(*entry), "cpu_s");
}

std::vector<Candidate> candidates(const Study& study, const store::Store& store, Table& runs) {
  const SpecsByKey specs(study);
  const auto earlier = earlierEnds(study);
  std::vector<Candidate> wanted;
  for (auto& row : runs.rows) {
    const auto spec = specs.find(row.front());
    // Times of this code do not belong to the counters of stale rows.
    const bool stale = textAt(runs, row, "code") != buildInfo().code;
    if (!spec || stale || !succeededAt(runs, row) || earlier.contains(store::keyNumber(row.front()))) continue;
    const double seconds = lengthOf(store, runs, row);
    const int repetitions = seconds > study.timing.once_above_s ? 1 : study.timing.repetitions;
    if (seconds > study.timing.skip_above_s || numberAt(runs, row, "cpu_runs") >= repetitions) continue;
    auto measured = measuredHere(store, runs, row);
    const double setup = measured.empty() ? kNotMeasured : numberAt(runs, row, "cpu_setup_s");
    wanted.push_back({&row, *spec, seconds, repetitions, std::move(measured), setup});
  }
  return wanted;
}

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

void timeStudy(const Study& study, store::Store& store, Table& runs, std::ostream& out) {
  auto wanted = candidates(study, store, runs);
  {
    Progress progress(out, study.id + " timing");
    for (const auto& candidate : wanted) {
      for (auto i = candidate.measured.size(); i < static_cast<std::size_t>(candidate.repetitions); ++i) {
        progress.expect(kindOf(candidate));
      }
    }
    for (int round = 0; round < study.timing.repetitions; ++round) {
      for (auto& candidate : wanted) {
        const bool measured = static_cast<std::size_t>(round) < candidate.measured.size();
        if (measured || round >= candidate.repetitions || interruptFlag()) continue;
        const double start = wallSeconds();
        RunSpec unlimited = candidate.spec;
        unlimited.time_limit = 0;
        const auto run = prepare(unlimited);
        // Warm up long runs, which are not repeated within the measurement: the first call touches new memory.
        if (candidate.repetitions > 1 && candidate.seconds > study.timing.min_time_s) run->wholeCall();
        candidate.measured.push_back(timeCall([&] { run->wholeCall(); }, study.timing.min_time_s));
        const double setup = timeCall([&] { run->setUp(); }, kSetUpPart * study.timing.min_time_s);
        candidate.setup_s = std::fmin(candidate.setup_s, setup);
        Timing timing = timingOf(candidate.measured);
        timing.setup_s = candidate.setup_s;
        setTiming(runs, *candidate.row, timing);
        store.addTimes(*candidate.row);
        progress.finished(kindOf(candidate), wallSeconds() - start);
      }
    }
  }
  std::vector<std::uint64_t> keys;
  for (const auto& row : runs.rows) keys.push_back(store::keyNumber(row.front()));
  store.exportTables(keys);
}

}  // namespace irk
