// The serial timing pass: Google Benchmark on the thread's CPU clock.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <vector>

#include "experiments/run_table.h"
#include "experiments/study.h"

namespace irk {

/// Minimum, median, spread and number of measured times; of an even number the upper median. At least one.
Timing timingOf(std::vector<double> seconds);

/// Seconds of one integration, the mean over at least `min_time_s`. Serial: call it alone.
double timeRun(PreparedRun& run, double min_time_s);

/// Times every successful run of the table that has not been timed as often as asked, and rewrites
/// `file` with the times: cpu_s (minimum), cpu_median_s, cpu_spread, cpu_runs. The repetitions are
/// rounds over the whole study: a machine that is slow for some seconds slows no run in all of them. After an
/// interrupt the finished ones are kept.
void timeStudy(const Study& study, const std::filesystem::path& file, Table& runs,
               std::ostream& progress);

}  // namespace irk
