// Finds the processes that make a study together.
#pragma once

#include "experiments/runner/ranks.h"

namespace irk {

/// The ranks of MPI_COMM_WORLD if mpirun has started this process, else this process alone. Throws Misuse under
/// mpirun if the program was built without MPI: every rank would make all runs.
std::unique_ptr<Ranks> joinRanks();

}  // namespace irk
