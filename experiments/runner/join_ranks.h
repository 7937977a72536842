// Finds the processes that make a study together.
#pragma once

#include "experiments/runner/ranks.h"

namespace irk {

/// The ranks of MPI_COMM_WORLD if mpirun or srun has started this process with others, else this process alone. Throws
/// Misuse if every rank would make all runs: the program was built without MPI, or srun has started it without MPI.
std::unique_ptr<Ranks> joinRanks();

}  // namespace irk
