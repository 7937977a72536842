// The processes that make one study together: this one alone, or the ranks that mpirun has started.
#pragma once

#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/runner/schedule/schedule.h"

namespace irk {

/// Distributes the pieces of a schedule on request over all threads of all ranks. Thread-safe.
class WorkQueue {
 public:
  virtual ~WorkQueue() = default;
  /// The next piece. Waits if there is none before another one is recorded. Nothing when all are recorded, and after
  /// an interrupt or `close`.
  virtual std::optional<Piece> next() = 0;
  /// The piece is done. Call it for every piece from `next`, unless the caller ends.
  virtual void record(const Piece& piece, const RunFacts& facts) = 0;
  /// Ends all waiting of this process.
  virtual void close() = 0;
};

/// The queue of one process.
class ProcessQueue final : public WorkQueue {
 public:
  explicit ProcessQueue(Schedule schedule) : schedule_(std::move(schedule)) {}
  std::optional<Piece> next() override;
  void record(const Piece& piece, const RunFacts& facts) override;
  void close() override;

  /// Like `next`, but does not wait: nothing and `over` = false mean that there may be a piece later.
  struct Now {
    std::optional<Piece> piece;
    bool over = false;
  };
  Now tryNext();

 private:
  Now nextNow();
  std::mutex mutex_;
  std::condition_variable changed_;
  bool closed_ = false;
  Schedule schedule_;
};

/// All ranks call `queue` and `meet` in the same order, from one thread. After an interrupt no rank waits for another
/// one, and `abandon` is the only permitted call.
class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual int rank() const = 0;   ///< 0 <= rank < count
  virtual int count() const = 0;  ///< >= 1
  /// Makes a queue of the pieces of a schedule. `schedule` is called on rank 0 only, which distributes the pieces; the
  /// destructor of its queue waits until all other ranks have destroyed theirs. On rank 0, `given` is called, in
  /// another thread, with each piece that another rank gets. Between ranks nothing is cancelled.
  using Given = std::function<void(const Piece&)>;
  virtual std::unique_ptr<WorkQueue> queue(const std::function<Schedule()>& schedule, Given given) = 0;
  /// Waits until all ranks have called it. It sleeps, so that waiting ranks do not disturb one that measures times.
  virtual void meet() = 0;
  /// The host of each rank. All ranks call it.
  virtual std::vector<std::string> hosts() = 0;
  /// The value of `said` on rank 0; false after an interrupt. All ranks call it.
  virtual bool asTheFirst(bool said) = 0;
  /// Ends all ranks with this exit status. Call it if one fails: the others would wait for it forever.
  [[noreturn]] virtual void abandon(int status) = 0;
};

/// This process alone.
std::unique_ptr<Ranks> aloneRank();
/// The ranks of MPI_COMM_WORLD; only where CMake has found MPI. Initializes MPI; the destructor finalizes it. Throws
/// Misuse if the MPI library does not support calls from several threads in turn.
std::unique_ptr<Ranks> mpiRanks();
/// The ranks of MPI_COMM_WORLD if mpirun or srun has started this process with others, else this process alone. Throws
/// Misuse if every rank would make all runs: the program was built without MPI, or srun has started it without MPI.
std::unique_ptr<Ranks> joinRanks();

/// The ranks that measure times, in ascending order: the first one of each host. The others must be idle, because they
/// would disturb the measurement.
std::vector<int> timingRanks(const std::vector<std::string>& hosts);

}  // namespace irk
