// The serial timing pass: Google Benchmark on the thread's CPU clock.
#pragma once

#include <filesystem>
#include <iosfwd>

#include "experiments/run_table.h"
#include "experiments/study.h"

namespace irk {

/// Times one prepared run: repetitions of at least min_time_s each. Serial: call it alone.
Timing timeRun(PreparedRun& run, const TimingOptions& options, int repetitions);

/// Times every successful run of the table that has not been timed yet, in the study's order, and
/// rewrites `file` with the times: cpu_s (minimum), cpu_median_s, cpu_spread, cpu_runs. After an
/// interrupt the finished ones are kept.
void timeStudy(const Study& study, const std::filesystem::path& file, Table& runs,
               std::ostream& progress);

}  // namespace irk
