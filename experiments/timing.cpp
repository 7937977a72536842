#include "experiments/timing.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "experiments/clock.h"
#include "experiments/interrupt.h"
#include "experiments/progress.h"
#include "experiments/runner.h"

namespace irk {
namespace {

/// Keeps the repetitions' seconds per integration; prints nothing.
class Collector final : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const auto& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
      seconds.push_back(run.cpu_accumulated_time / static_cast<double>(run.iterations));
    }
  }
  std::vector<double> seconds;
};

struct Candidate {
  TableRow* row;
  const RunSpec* spec;
  double seconds;  // of the accuracy run
};

// Runs of about the same length take about the same time to be timed.
std::string kindOf(const Candidate& candidate) {
  return std::to_string(std::ilogb(candidate.seconds));
}

std::vector<Candidate> candidates(const Study& study, Table& runs) {
  const auto specs = specsByKey(study);
  std::vector<Candidate> wanted;
  for (auto& row : runs.rows) {
    const auto spec = specs.find(row.front());
    const double seconds = numberAt(runs, row, "cpu_s");
    const bool timed = numberAt(runs, row, "cpu_runs") > 0;
    if (spec == specs.end() || timed || !succeededAt(runs, row)) continue;
    if (seconds <= study.timing.skip_above_s) wanted.push_back({&row, spec->second, seconds});
  }
  return wanted;
}

}  // namespace

Timing timeRun(PreparedRun& run, const TimingOptions& options, int repetitions) {
  benchmark::RegisterBenchmark("run",
                               [&run](benchmark::State& state) {
                                 for ([[maybe_unused]] auto _ : state) run.integrate();
                               })
      ->MinTime(options.min_time_s)
      ->Repetitions(repetitions);
  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector);
  benchmark::ClearRegisteredBenchmarks();
  auto& seconds = collector.seconds;
  std::sort(seconds.begin(), seconds.end());
  const double least = seconds.front();
  return {least, seconds[seconds.size() / 2], (seconds.back() - least) / least,
          static_cast<int>(seconds.size())};
}

void timeStudy(const Study& study, const std::filesystem::path& file, Table& runs,
               std::ostream& out) {
  const auto wanted = candidates(study, runs);
  {
    Progress progress(out, study.id + " timing");
    for (const auto& candidate : wanted) progress.expect(kindOf(candidate));
    RowWriter writer(file, runs);
    for (const auto& candidate : wanted) {
      if (interruptFlag()) break;
      const double start = wallSeconds();
      RunSpec unlimited = *candidate.spec;
      unlimited.time_limit = 0;
      const auto run = prepare(unlimited);
      const bool once = candidate.seconds > study.timing.once_above_s;
      setTiming(runs, *candidate.row,
                timeRun(*run, study.timing, once ? 1 : study.timing.repetitions));
      writer.append(*candidate.row);
      progress.finished(kindOf(candidate), wallSeconds() - start);
    }
  }
  writeTable(file, runs);
}

}  // namespace irk
