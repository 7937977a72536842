// The timing pass: Google Benchmark on the thread's CPU clock, on one core or on several at once.
#pragma once

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <optional>
#include <vector>

#include "experiments/runner/ranks.h"
#include "experiments/runner/runner.h"
#include "experiments/runs/run_table.h"
#include "experiments/store/store.h"
#include "experiments/study/study.h"

namespace irk {

/// Minimum, median, spread and number of the times (at least one); for an even number the upper median.
Timing timingOf(std::vector<double> seconds);

/// Seconds of one call, the mean over at least `min_time_s`. Call it while nothing else runs.
double timeCall(const std::function<void()>& call, double min_time_s);
using TimeCall = std::function<double(const std::function<void()>& call, double min_time_s)>;

/// How often the timing pass measures a run whose least time so far is known: 0 for a run that keeps the time of its
/// accuracy run, 1 for a long run.
std::size_t repetitionsFor(const TimingOptions& timing, double least_s);

/// The series that one of several hosts times: those with i % hosts == host. One host makes all repetitions of a run.
struct TimingShare {
  std::size_t host = 0, hosts = 1;
  int cores = 1;  ///< of the host, on which runs are timed at once; 0: as many as do not disturb each other
};

/// This rank's share; nothing if it must be idle because another rank on its host measures. All ranks call it.
std::optional<TimingShare> timingShare(Ranks& ranks, const RunnerOptions& options);

/// Times every successful run of the store that has fewer repetitions than requested (on this processor or on any, as
/// the store's options say). Writes the columns cpu_s (minimum), cpu_setup_s, cpu_median_s, cpu_spread, cpu_runs,
/// cpu_all. It times the whole call as a user makes it: set-up and integration. Each round of repetitions covers the
/// whole study, so that a machine that is slow for some seconds does not slow all repetitions of a run. Every new time
/// is a new row of the store: after an interrupt only the missing ones are measured. A calibration is measured with the
/// first run and then every second, and stored with the times of that run. Call it while nothing else runs on this
/// host.
///
/// On one core the runs are measured one after the other in this process; on several at once, each in a process of its
/// own on a core of its own (cores/children.h). A run that has several threads (`threads`) is measured alone, in this
/// process. On how many cores, and why, is stored (timing_cores.csv) and told on `progress`. A run that cannot be
/// measured, as it throws or its process dies, keeps its row; `detail` then says why it has no times, and the next pass
/// tries again.
///
/// The least time so far decides how often a run is measured, so that one slow measurement decides nothing: after a
/// slow accuracy run the first measurement decides again, and a slow first measurement is made twice before it is
/// stored.
void timeStudy(const Study& study, const RunKeys& keys, store::Store& store, TimingShare share, std::ostream& progress,
               const TimeCall& time_call = timeCall);

}  // namespace irk
