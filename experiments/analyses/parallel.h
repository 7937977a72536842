// parallel.csv: what more processors gain, for one run on several threads and for several runs at a time.
#pragma once

#include <iosfwd>
#include <vector>

#include "experiments/analyses/run_file.h"
#include "experiments/study/study.h"

namespace irk {

/// 1, 2, 4, ... and `processors` itself, ascending; processors > 0.
std::vector<int> processorCounts(int processors);

/// Repeats every successful run of the study on each number of processors, in two ways: `threads`, one run on so many
/// threads; `runs`, so many runs at a time on one thread each, as --jobs makes them. A time is the least of five by the
/// clock on the wall, set-up included; each of five rounds measures all numbers of processors and both ways, so that a
/// machine that is slow for a while slows all of them. Call it while nothing else runs. Columns: those of a series, n
/// (unknowns of one stage), way, processors, wall_s, speedup (runs per second over those on one processor), efficiency
/// (the same by processor) and serial_share.
Table parallelTable(const Study& study, const RunFile& runs, const std::vector<int>& processors,
                    std::ostream& progress);

/// The part of the work on one processor that one processor has to do alone, if the others share the rest evenly and
/// `speedup` is measured on p > 1 processors: (1 / speedup - 1 / p) / (1 - 1 / p). Amdahl's law solved for it: Karp and
/// Flatt, Comm. ACM 33 (1990). Any number of processors gives at most 1 / serialShare. NaN for p = 1.
double serialShare(double speedup, int p);

}  // namespace irk
