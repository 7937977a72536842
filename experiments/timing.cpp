#include "experiments/timing.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "experiments/clock.h"
#include "experiments/interrupt.h"
#include "experiments/progress.h"
#include "experiments/runner.h"

namespace irk {
namespace {

/// Keeps the seconds per integration; prints nothing.
class Collector final : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override {
    for (const auto& run : runs) {
      if (run.run_type != Run::RT_Iteration || run.error_occurred) continue;
      seconds = run.cpu_accumulated_time / static_cast<double>(run.iterations);
    }
  }
  double seconds = std::numeric_limits<double>::quiet_NaN();
};

struct Candidate {
  TableRow* row;
  const RunSpec* spec;
  double seconds;  // of the accuracy run
  int repetitions;
  int there;  // of a pass that was interrupted
  std::vector<double> measured;
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
    const int repetitions = seconds > study.timing.once_above_s ? 1 : study.timing.repetitions;
    const int there = static_cast<int>(numberAt(runs, row, "cpu_runs"));
    if (spec == specs.end() || there >= repetitions || !succeededAt(runs, row)) continue;
    if (seconds > study.timing.skip_above_s) continue;
    wanted.push_back({&row, spec->second, seconds, repetitions, there, {}});
  }
  return wanted;
}

}  // namespace

Timing timingOf(std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  const double least = seconds.front();
  return {least, seconds[seconds.size() / 2], (seconds.back() - least) / least,
          static_cast<int>(seconds.size())};
}

double timeRun(PreparedRun& run, double min_time_s) {
  benchmark::RegisterBenchmark("run",
                               [&run](benchmark::State& state) {
                                 for ([[maybe_unused]] auto _ : state) run.integrate();
                               })
      ->MinTime(min_time_s);
  Collector collector;
  benchmark::RunSpecifiedBenchmarks(&collector);
  benchmark::ClearRegisteredBenchmarks();
  return collector.seconds;
}

void timeStudy(const Study& study, const std::filesystem::path& file, Table& runs,
               std::ostream& out) {
  auto wanted = candidates(study, runs);
  {
    Progress progress(out, study.id + " timing");
    for (const auto& candidate : wanted) {
      for (int i = 0; i < candidate.repetitions; ++i) progress.expect(kindOf(candidate));
    }
    RowWriter writer(file, runs);
    for (int round = 0; round < study.timing.repetitions; ++round) {
      for (auto& candidate : wanted) {
        if (round >= candidate.repetitions || interruptFlag()) continue;
        const double start = wallSeconds();
        RunSpec unlimited = *candidate.spec;
        unlimited.time_limit = 0;
        const auto run = prepare(unlimited);
        // A run so long that it is not repeated within the measurement: what it allocates once is there.
        if (candidate.repetitions > 1 && candidate.seconds > study.timing.min_time_s) run->integrate();
        candidate.measured.push_back(timeRun(*run, study.timing.min_time_s));
        if (round + 1 > candidate.there) {
          setTiming(runs, *candidate.row, timingOf(candidate.measured));
          writer.append(*candidate.row);
        }
        progress.finished(kindOf(candidate), wallSeconds() - start);
      }
    }
  }
  writeTable(file, runs);
}

}  // namespace irk
