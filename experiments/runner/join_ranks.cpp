#include "experiments/runner/join_ranks.h"

#include <fmt/format.h>

#include <cstdlib>

#include "irk/misuse.h"

#ifdef IRK_HAS_MPI
#include "experiments/runner/mpi_ranks.h"
#endif

namespace irk {
namespace {

// The number of ranks that the launcher announces: Open MPI, or MPICH and its relatives.
int announcedRanks() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
    if (const char* text = std::getenv(name)) return std::atoi(text);
  }
  return 1;
}

}  // namespace

std::unique_ptr<Ranks> joinRanks() {
  const int announced = announcedRanks();
  if (announced <= 1) return aloneRank();
#ifdef IRK_HAS_MPI
  return mpiRanks();
#else
  throw Misuse(
      fmt::format("{} ranks of mpirun, but this program was built without MPI: every rank would make all "
                  "runs. Install an MPI (Debian: libopenmpi-dev) and build again",
                  announced));
#endif
}

}  // namespace irk
