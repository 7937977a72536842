#ifdef IRK_HAS_MPI

#include "experiments/runner/ranks.h"

#include <mpi.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

#include "experiments/base/interrupt.h"
#include "experiments/tables/environment.h"
#include "irk/misuse.h"

namespace irk {
namespace {

constexpr int kAsk = 1, kGive = 2, kDone = 3, kRecord = 4;  // tags of messages

/// The text of all messages, of fixed size. `series` is kNothing in an answer when all pieces are done. A record has
/// the facts of the run.
struct Message {
  std::int64_t series = 0, run = 0;
  std::array<char, 32> outcome = {};
  GroupErrors errors = {};
};
constexpr std::int64_t kNothing = -1;
constexpr int kBytes = sizeof(Message);
constexpr auto kNap = std::chrono::milliseconds(1);

/// Allows one MPI call at a time: MPI_THREAD_SERIALIZED. No call blocks while the lock is held.
std::mutex& mpiLock() {
  static std::mutex mutex;
  return mutex;
}

// Waits by sleeping: a blocking MPI call would keep busy a core that others need. Returns false after an interrupt,
// because the other rank may have ended, and when `closed`.
bool wait(MPI_Request& request, const std::atomic<bool>* closed = nullptr) {
  while (!interruptFlag() && !(closed && *closed)) {
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

void send(const Message& message, int to, int tag) {
  static thread_local Message sent;
  sent = message;
  MPI_Request request;
  {
    const std::lock_guard lock(mpiLock());
    MPI_Isend(&sent, kBytes, MPI_BYTE, to, tag, MPI_COMM_WORLD, &request);
  }
  wait(request);
}

/// The queue of rank 0: a thread answers the other ranks; its own threads use the same queue.
class GivingQueue final : public WorkQueue {
 public:
  GivingQueue(Schedule schedule, int others, Ranks::Given given)
      : queue_(std::move(schedule)), others_(others), given_(std::move(given)) {
    server_ = std::thread([this] { serve(); });
  }
  ~GivingQueue() override { server_.join(); }
  std::optional<Piece> next() override { return queue_.next(); }
  void record(const Piece& piece, const RunFacts& facts) override { queue_.record(piece, facts); }
  void close() override { queue_.close(); }

 private:
  void serve() {
    for (int working = others_; working > 0 && !interruptFlag();) {
      const int tag = receiveOne();
      if (tag == kDone) --working;
      const bool answered = answerOne();
      if (tag == 0 && !answered) std::this_thread::sleep_for(kNap);
    }
  }
  // Receives one message and returns its tag; 0 if there was none.
  int receiveOne() {
    MPI_Status status;
    Message message;
    {
      const std::lock_guard lock(mpiLock());
      int there = 0;
      MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
      if (!there) return 0;
      MPI_Recv(&message, kBytes, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    }
    if (status.MPI_TAG == kAsk) asking_.push_back(status.MPI_SOURCE);
    if (status.MPI_TAG == kRecord) {
      const Piece piece{static_cast<std::size_t>(message.series), static_cast<std::size_t>(message.run)};
      queue_.record(piece, {message.outcome.data(), message.errors});
    }
    return status.MPI_TAG;
  }
  // Answers the rank that has asked first, if there is a piece for it.
  bool answerOne() {
    if (asking_.empty()) return false;
    const auto [piece, over] = queue_.tryNext();
    if (!piece && !over) return false;
    if (piece && given_) given_(*piece);
    Message message{.series = kNothing};
    if (piece)
      message = {.series = static_cast<std::int64_t>(piece->series), .run = static_cast<std::int64_t>(piece->run)};
    send(message, asking_.front(), kGive);
    asking_.pop_front();
    return true;
  }

  ProcessQueue queue_;
  int others_;
  Ranks::Given given_;
  std::deque<int> asking_;
  std::thread server_;
};

/// The queue of the other ranks: one request at a time.
class AskingQueue final : public WorkQueue {
 public:
  ~AskingQueue() override { send({}, 0, kDone); }
  std::optional<Piece> next() override {
    const std::lock_guard turn(turn_);
    if (closed_) return std::nullopt;
    MPI_Request request;
    {
      const std::lock_guard lock(mpiLock());
      MPI_Irecv(&given_, kBytes, MPI_BYTE, 0, kGive, MPI_COMM_WORLD, &request);
    }
    send({}, 0, kAsk);
    if (!wait(request, &closed_) || given_.series == kNothing) closed_ = true;
    if (closed_) return std::nullopt;
    return Piece{static_cast<std::size_t>(given_.series), static_cast<std::size_t>(given_.run)};
  }
  void record(const Piece& piece, const RunFacts& facts) override {
    Message message{static_cast<std::int64_t>(piece.series), static_cast<std::int64_t>(piece.run), {}, facts.errors};
    facts.outcome.copy(message.outcome.data(), message.outcome.size() - 1);
    send(message, 0, kRecord);
  }
  void close() override { closed_ = true; }

 private:
  std::mutex turn_;
  Message given_;
  std::atomic<bool> closed_ = false;
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
  std::unique_ptr<WorkQueue> queue(const std::function<Schedule()>& schedule, Given given) override {
    meet();  // all messages of the previous queue are received
    if (rank_ == 0) return std::make_unique<GivingQueue>(schedule(), count_ - 1, std::move(given));
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
