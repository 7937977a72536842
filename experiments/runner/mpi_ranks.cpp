#ifdef IRK_HAS_MPI

#include "experiments/runner/mpi_ranks.h"

#include <mpi.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <thread>
#include <utility>

#include "experiments/base/interrupt.h"
#include "experiments/tables/environment.h"
#include "irk/misuse.h"

namespace irk {
namespace {

constexpr int kAsk = 1, kGive = 2, kDone = 3;  // tags of messages
constexpr std::int64_t kNothing = -1;
constexpr auto kNap = std::chrono::milliseconds(1);

/// Allows one MPI call at a time: MPI_THREAD_SERIALIZED. No call blocks while the lock is held.
std::mutex& mpiLock() {
  static std::mutex mutex;
  return mutex;
}

// Waits by sleeping: a blocking MPI call would keep busy a core that others need. Returns false after an interrupt,
// because the other rank may have ended.
bool wait(MPI_Request& request) {
  while (!interruptFlag()) {
    {
      const std::lock_guard lock(mpiLock());
      int done = 0;
      MPI_Test(&request, &done, MPI_STATUS_IGNORE);
      if (done) return true;
    }
    std::this_thread::sleep_for(kNap);
  }
  return false;
}

void send(std::int64_t value, int to, int tag) {
  static thread_local std::int64_t sent;
  sent = value;
  MPI_Request request;
  {
    const std::lock_guard lock(mpiLock());
    MPI_Isend(&sent, 1, MPI_INT64_T, to, tag, MPI_COMM_WORLD, &request);
  }
  wait(request);
}

/// The queue of rank 0: a thread answers the other ranks; its own threads use the same counter.
class GivingQueue final : public WorkQueue {
 public:
  GivingQueue(std::vector<std::size_t> order, int others, Ranks::Given given)
      : order_(std::move(order)), others_(others), given_(std::move(given)) {
    server_ = std::thread([this] { serve(); });
  }
  ~GivingQueue() override { server_.join(); }
  std::optional<std::size_t> next() override {
    const std::size_t i = next_.fetch_add(1);
    return i < order_.size() ? std::optional(order_[i]) : std::nullopt;
  }

 private:
  void serve() {
    for (int working = others_; working > 0 && !interruptFlag();) {
      const int tag = receiveOne();
      if (tag == kDone) --working;
      if (tag == 0) std::this_thread::sleep_for(kNap);
    }
  }
  // Answers one message and returns its tag; 0 if there was none.
  int receiveOne() {
    MPI_Status status;
    std::int64_t ignored = 0;
    {
      const std::lock_guard lock(mpiLock());
      int there = 0;
      MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
      if (!there) return 0;
      MPI_Recv(&ignored, 1, MPI_INT64_T, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    }
    if (status.MPI_TAG == kAsk) {
      const auto i = next();
      if (i && given_) given_(*i);
      send(i ? static_cast<std::int64_t>(*i) : kNothing, status.MPI_SOURCE, kGive);
    }
    return status.MPI_TAG;
  }

  std::vector<std::size_t> order_;
  int others_;
  Ranks::Given given_;
  std::atomic<std::size_t> next_ = 0;
  std::thread server_;
};

/// The queue of the other ranks: one request at a time.
class AskingQueue final : public WorkQueue {
 public:
  ~AskingQueue() override { send(0, 0, kDone); }
  std::optional<std::size_t> next() override {
    const std::lock_guard turn(turn_);
    if (over_) return std::nullopt;
    MPI_Request request;
    {
      const std::lock_guard lock(mpiLock());
      MPI_Irecv(&given_, 1, MPI_INT64_T, 0, kGive, MPI_COMM_WORLD, &request);
    }
    send(0, 0, kAsk);
    over_ = !wait(request) || given_ == kNothing;
    return over_ ? std::nullopt : std::optional(static_cast<std::size_t>(given_));
  }

 private:
  std::mutex turn_;
  std::int64_t given_ = kNothing;
  bool over_ = false;
};

class MpiRanks final : public Ranks {
 public:
  MpiRanks() {
    int provided = MPI_THREAD_SINGLE;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided);
    if (provided < MPI_THREAD_SERIALIZED) {
      MPI_Finalize();
      throw Misuse("this MPI library cannot be called from several threads in turn (MPI_THREAD_SERIALIZED)");
    }
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &count_);
  }
  ~MpiRanks() override {
    meet();
    MPI_Finalize();
  }
  MpiRanks(const MpiRanks&) = delete;
  MpiRanks& operator=(const MpiRanks&) = delete;

  int rank() const override { return rank_; }
  int count() const override { return count_; }
  std::unique_ptr<WorkQueue> queue(std::vector<std::size_t> order, Given given) override {
    meet();  // all messages of the previous queue are received
    if (rank_ == 0) return std::make_unique<GivingQueue>(std::move(order), count_ - 1, std::move(given));
    return std::make_unique<AskingQueue>();
  }
  void meet() override {
    MPI_Request request;
    {
      const std::lock_guard lock(mpiLock());
      MPI_Ibarrier(MPI_COMM_WORLD, &request);
    }
    wait(request);
  }
  std::vector<std::string> hosts() override {
    using Name = std::array<char, 256>;
    Name own{};
    hostName().copy(own.data(), own.size() - 1);
    std::vector<Name> names(static_cast<std::size_t>(count_));
    MPI_Request request;
    {
      const std::lock_guard lock(mpiLock());
      MPI_Iallgather(own.data(), own.size(), MPI_CHAR, names.data(), own.size(), MPI_CHAR, MPI_COMM_WORLD, &request);
    }
    wait(request);
    std::vector<std::string> hosts;
    for (const Name& name : names) hosts.emplace_back(name.data());
    return hosts;
  }
  bool asTheFirst(bool said) override {
    int value = said ? 1 : 0;
    MPI_Request request;
    {
      const std::lock_guard lock(mpiLock());
      MPI_Ibcast(&value, 1, MPI_INT, 0, MPI_COMM_WORLD, &request);
    }
    return wait(request) && value == 1;
  }
  [[noreturn]] void abandon(int status) override {
    MPI_Abort(MPI_COMM_WORLD, status);
    std::_Exit(status);
  }

 private:
  int rank_ = 0, count_ = 1;
};

}  // namespace

std::unique_ptr<Ranks> mpiRanks() { return std::make_unique<MpiRanks>(); }

}  // namespace irk

#endif  // IRK_HAS_MPI
