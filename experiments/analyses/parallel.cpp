#include "experiments/analyses/parallel.h"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <string_view>
#include <thread>

#include "core/base/threads.h"
#include "experiments/base/clock.h"
#include "experiments/base/interrupt.h"
#include "experiments/base/numbers.h"
#include "experiments/base/progress.h"
#include "experiments/runs/run.h"
#include "experiments/runs/run_table.h"
#include "experiments/runs/setup.h"
#include "experiments/study/analysis.h"

namespace irk {
namespace {

constexpr int kTimes = 5;
constexpr std::array<std::string_view, 2> kWays = {"threads", "runs"};

/// Measures one run on several numbers of processors.
class ParallelMeasurement {
 public:
  ParallelMeasurement(const RunSpec& spec, std::vector<int> processors) : processors_(std::move(processors)) {
    RunSpec one = spec;
    one.time_limit = 0;
    one.options.threads = 1;
    while (runs_.size() < static_cast<std::size_t>(processors_.back())) runs_.push_back(prepare(one));
    for (const int p : processors_) {
      one.options.threads = p;
      threads_.push_back(prepare(one));
    }
    for (auto& least : least_) least.resize(processors_.size(), std::numeric_limits<double>::infinity());
  }

  void measure() {
    for (int time = 0; time < kTimes; ++time) {
      for (std::size_t i = 0; i < processors_.size() && !interruptFlag(); ++i) {
        take(least_[0][i], [&] { threads_[i]->wholeCall(); });
        take(least_[1][i], [&] {
          const auto p = static_cast<std::size_t>(processors_[i]);
          onThreads(processors_[i], p, [&](std::size_t run) { runs_[run]->wholeCall(); });
        });
      }
    }
  }

  // Cells from the column `way` on.
  void appendRows(const TableRow& row, Table& table) const {
    for (std::size_t way = 0; way < kWays.size(); ++way) {
      for (std::size_t i = 0; i < processors_.size(); ++i) {
        const int p = processors_[i];
        const double seconds = least_[way][i], work = way == 0 ? 1 : p;
        const double speedup = work * least_[way].front() / seconds;
        TableRow all = row;
        all.emplace_back(kWays[way]);
        for (const double x : {static_cast<double>(p), seconds, speedup, speedup / p, serialShare(speedup, p)}) {
          all.push_back(numberText(x));
        }
        table.rows.push_back(std::move(all));
      }
    }
  }

 private:
  template <class Call>
  static void take(double& least, const Call& call) {
    const double start = wallSeconds();
    call();
    least = std::min(least, wallSeconds() - start);
  }

  std::vector<int> processors_;
  std::vector<std::unique_ptr<PreparedRun>> runs_;            // one for each processor
  std::vector<std::unique_ptr<PreparedRun>> threads_;         // one for each number of processors
  std::array<std::vector<double>, kWays.size()> least_ = {};  // s, by way and number of processors
};

}  // namespace

std::vector<int> processorCounts(int processors) {
  std::vector<int> counts;
  for (int p = 1; p < processors; p *= 2) counts.push_back(p);
  counts.push_back(processors);
  return counts;
}

double serialShare(double speedup, int p) {
  if (p == 1) return std::numeric_limits<double>::quiet_NaN();
  return (1 / speedup - 1.0 / p) / (1 - 1.0 / p);
}

Table parallelTable(const Study& study, const RunFile& runs, const std::vector<int>& processors, std::ostream& out) {
  const Table& names = runs.names();
  Table table{names.head, seriesColumns(names), {}};
  table.columns.insert(table.columns.end(),
                       {"n", "way", "processors", "wall_s", "speedup", "efficiency", "serial_share"});
  Progress progress(out, study.id + " on " + std::to_string(processors.back()) + " processors");
  repeatRuns(study, runs, &progress, [&](const RunSeries& series, const TableRow&, const RunSpec& spec) {
    TableRow row = series.name;
    row.push_back(std::to_string(makeSetup<double>(spec).system->sizes().n()));
    ParallelMeasurement measurement(spec, processors);
    measurement.measure();
    if (!interruptFlag()) measurement.appendRows(row, table);
  });
  return table;
}

Analysis parallelAnalysis() {
  return {.key = "parallel",
          .meaning = "what more processors gain: one run on several threads, several runs at a time",
          .writes = "parallel.csv",
          .run = [](const AnalysisInput& in) {
            const int processors = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
            writeTable(in.folder / "parallel.csv",
                       parallelTable(in.study, in.runs, processorCounts(processors), in.progress));
          }};
}

}  // namespace irk
