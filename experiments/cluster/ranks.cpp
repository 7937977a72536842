#include "experiments/cluster/ranks.h"

#include <fmt/format.h>

#include <atomic>
#include <cstdlib>

#include "core/misuse.h"

#ifdef IRK_HAS_MPI
#include "experiments/cluster/mpi_ranks.h"
#endif

namespace irk {
namespace {

class OneQueue final : public WorkQueue {
 public:
  explicit OneQueue(std::size_t count) : count_(count) {}
  std::optional<std::size_t> next() override {
    const std::size_t i = next_.fetch_add(1);
    return i < count_ ? std::optional(i) : std::nullopt;
  }

 private:
  std::size_t count_;
  std::atomic<std::size_t> next_ = 0;
};

class Alone final : public Ranks {
 public:
  int rank() const override { return 0; }
  int count() const override { return 1; }
  std::unique_ptr<WorkQueue> queue(std::size_t count, Given) override {
    return std::make_unique<OneQueue>(count);
  }
  void meet() override {}
  [[noreturn]] void abandon(int status) override { std::exit(status); }
};

// The number of ranks that a launcher has announced: of Open MPI, of MPICH and its relatives.
int announcedRanks() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"}) {
    if (const char* text = std::getenv(name)) return std::atoi(text);
  }
  return 1;
}

}  // namespace

std::unique_ptr<Ranks> aloneRank() { return std::make_unique<Alone>(); }

std::unique_ptr<Ranks> joinRanks() {
  const int announced = announcedRanks();
  if (announced <= 1) return aloneRank();
#ifdef IRK_HAS_MPI
  return mpiRanks();
#else
  throw Misuse(fmt::format("{} ranks of mpirun, but this program was built without MPI: every rank would make all "
                           "runs. Install an MPI (Debian: libopenmpi-dev) and build again",
                           announced));
#endif
}

}  // namespace irk
