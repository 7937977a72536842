// The ranks of MPI_COMM_WORLD. Compiled only where CMake has found MPI.
#pragma once

#include "experiments/runner/ranks.h"

namespace irk {

/// Initialises MPI; its end finalises it. Throws Misuse where the MPI library cannot be called from several threads
/// in turn.
std::unique_ptr<Ranks> mpiRanks();

}  // namespace irk
