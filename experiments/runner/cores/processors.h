// The processors on which runs can be timed at once: one of each physical core.
#pragma once

#include <filesystem>
#include <vector>

namespace irk::cores {

/// One of `allowed` for each physical core. Cores of different last-level caches take turns, so that the first ones
/// share as little as possible. `system`: /sys/devices/system/cpu; where it does not tell what a processor shares, the
/// processor counts as a core of its own.
std::vector<int> physicalCores(const std::vector<int>& allowed, const std::filesystem::path& system);

/// Those of this process, which taskset, Slurm or mpirun may have confined to some of the machine. At least one. Throws
/// Failure if the system does not tell them.
std::vector<int> physicalCores();

/// Runs the calling process on this processor only. Throws Failure if it may not be used.
void pinTo(int processor);

}  // namespace irk::cores
