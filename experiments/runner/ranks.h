// The processes that make one study together: this one alone, or the ranks that mpirun has started.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>

namespace irk {

/// Hands out 0, 1, ..., count - 1, each of them once, over all threads of all ranks, as they ask.
class WorkQueue {
 public:
  virtual ~WorkQueue() = default;
  /// The next one; nothing when all are given out. Thread-safe.
  virtual std::optional<std::size_t> next() = 0;
};

/// All ranks call `queue` and `meet` in the same order, from one thread. After an interrupt nobody waits for another rank
/// any more, and `abandon` is the only call that is left.
class Ranks {
 public:
  virtual ~Ranks() = default;
  virtual int rank() const = 0;   ///< 0 <= rank < count
  virtual int count() const = 0;  ///< >= 1
  /// The queue of `count` pieces of work. Rank 0 gives them out until every other rank has destroyed its queue: its
  /// destructor waits for that. There `given` hears of each piece that another rank gets, from another thread.
  using Given = std::function<void(std::size_t)>;
  virtual std::unique_ptr<WorkQueue> queue(std::size_t count, Given given) = 0;
  /// Waits, asleep, until all ranks are here: a rank that waits does not disturb one that measures times.
  virtual void meet() = 0;
  /// Ends all ranks with this exit status: one of them failed, and the others would wait for it for ever.
  [[noreturn]] virtual void abandon(int status) = 0;
};

/// This process alone.
std::unique_ptr<Ranks> aloneRank();

}  // namespace irk
