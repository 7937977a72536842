// The processes that make one study together: this one alone, or the ranks that mpirun has started.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace irk {

/// Distributes numbers on request over all threads of all ranks, each once.
class WorkQueue {
 public:
  virtual ~WorkQueue() = default;
  /// The next number; nullopt when all are distributed. Thread-safe.
  virtual std::optional<std::size_t> next() = 0;
};

/// All ranks call `queue` and `meet` in the same order, from one thread. After an interrupt no rank waits for another
/// one, and `abandon` is the only permitted call.
class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual int rank() const = 0;   ///< 0 <= rank < count
  virtual int count() const = 0;  ///< >= 1
  /// Makes a queue of the pieces of work `order`. Only the list of rank 0 counts; rank 0 distributes its pieces in this
  /// order, and the destructor of its queue waits until all other ranks have destroyed theirs. On rank 0, `given` is
  /// called, in another thread, with each piece that another rank gets.
  using Given = std::function<void(std::size_t)>;
  virtual std::unique_ptr<WorkQueue> queue(std::vector<std::size_t> order, Given given) = 0;
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

/// The ranks that measure times, in ascending order: the first one of each host. The others must be idle, because they
/// would disturb the measurement.
std::vector<int> timingRanks(const std::vector<std::string>& hosts);

}  // namespace irk
