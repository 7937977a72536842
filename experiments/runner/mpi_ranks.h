// The ranks of MPI_COMM_WORLD. Compiled only where CMake has found MPI.
#pragma once

#include "experiments/runner/ranks.h"

namespace irk {

/// Initializes MPI; the destructor finalizes it. Throws Misuse if the MPI library does not support calls from several
/// threads in turn.
std::unique_ptr<Ranks> mpiRanks();

}  // namespace irk
