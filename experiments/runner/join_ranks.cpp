#include "experiments/runner/ranks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "irk/misuse.h"

namespace irk {
namespace {

/// What a launcher of processes has set in the environment.
struct Launch {
  const char* variable = nullptr;
  int ranks = 1;  ///< 0 = not said
};

// Open MPI; MPICH and its relatives; srun, whose step has tasks, with or without MPI; any launcher with PMIx.
Launch launchOf() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
    if (const char* text = std::getenv(name)) return {name, std::max(1, std::atoi(text))};
  }
  if (std::getenv("PMIX_RANK")) return {"PMIX_RANK", 0};
  return {};
}

}  // namespace

std::unique_ptr<Ranks> joinRanks() {
  const Launch launch = launchOf();
  if (launch.ranks == 1) return aloneRank();
#ifdef IRK_HAS_MPI
  auto ranks = mpiRanks();
  if (launch.ranks <= 1 || ranks->count() > 1) return ranks;
  throw Misuse(fmt::format(
      "{0} = {1}: {1} processes were started, but MPI knows of this one only, and each would make all runs: "
      "use srun --mpi=pmix (srun --mpi=list shows what there is) or mpirun",
      launch.variable, launch.ranks));
#else
  throw Misuse(
      fmt::format("{} = {}: several ranks, but this program was built without MPI: every rank would make all "
                  "runs. Install an MPI (Debian: libopenmpi-dev) and build again",
                  launch.variable, std::getenv(launch.variable)));
#endif
}

}  // namespace irk
