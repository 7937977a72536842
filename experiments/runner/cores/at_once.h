// On how many cores runs are timed at once: on as many as do not disturb each other, which is measured.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "experiments/store/calibration.h"

namespace irk::cores {

/// Two fixed computations may take so many times as long on several cores at once as on one core alone, and the cores
/// count as undisturbed. `irk compare` counts changes of times from 5 % on; what cores do to each other must stay
/// below.
inline constexpr double kUndisturbed = 1.03;

/// CPU seconds of the two computations: the calibration's elimination, which needs the core only, and a sum of long
/// vectors, which needs the shared caches and the memory.
struct KernelSeconds {
  double elimination, vectors;
};
/// Measures on so many cores at once; of several cores the slowest counts, with infinite seconds if it fails.
using MeasureCores = std::function<KernelSeconds(std::size_t cores)>;

/// Measures 1, 2, 4, ... and `most` cores (at least 1) up to the first number on which one of the computations is
/// slower than kUndisturbed allows. The last number before that is taken. One core alone is measured before and after
/// each number, and the lesser times count: other load beside it must not hide what the cores do to each other.
std::vector<store::CoresTrial> tryCores(std::size_t most, const MeasureCores& measure);

/// The two computations on the first ones of these processors, each in a process of its own: the median of 0.1 s each.
KernelSeconds measureOn(const std::vector<int>& processors, std::size_t cores);

/// The number of cores that was taken.
std::size_t takenOf(const std::vector<store::CoresTrial>& trials);

/// What was measured and taken, in one line: `2 of 4 cores at once; ...`. `available`: cores of this process.
std::string textOf(const std::vector<store::CoresTrial>& trials, std::size_t available);

/// Throws Misuse, naming the option, unless `asked` is 0 or a number of cores that this process may use.
void requireCores(int asked);

}  // namespace irk::cores
