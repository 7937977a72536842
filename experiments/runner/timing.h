// The serial timing pass: Google Benchmark on the thread's CPU clock.
#pragma once

#include <iosfwd>
#include <vector>

#include "experiments/runs/run_table.h"
#include "experiments/store/store.h"
#include "experiments/study/study.h"

namespace irk {

/// Minimum, median, spread and number of measured times; of an even number the upper median. At least one.
Timing timingOf(std::vector<double> seconds);

/// Seconds of one integration, the mean over at least `min_time_s`. Serial: call it alone.
double timeRun(PreparedRun& run, double min_time_s);

/// Times every successful run of the table that has not been timed as often as asked, here or as the store's options
/// say anywhere: cpu_s (minimum), cpu_median_s, cpu_spread, cpu_runs, cpu_all. The repetitions are rounds over the whole
/// study: a machine that is slow for some seconds slows no run in all of them. Each is a new row of the store, so that
/// after an interrupt only the missing ones are made; at the end the tables are exported again.
void timeStudy(const Study& study, store::Store& store, Table& runs, std::ostream& progress);

}  // namespace irk
