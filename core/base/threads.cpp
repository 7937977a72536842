#include "core/base/threads.h"

#include <omp.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <system_error>
#include <thread>
#include <vector>

namespace irk::detail {
namespace {

// Whether this thread is inside a loop of a team.
thread_local bool in_loop = false;

// While a thread waits, it looks so often for work before it sleeps, about 50 microseconds: the next loop of a step
// comes within that time as a rule, and a sleeping thread takes some microseconds to wake.
constexpr int kLooks = 2000;

void pause() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#endif
}

/// Threads that take the turns of one loop after the other. OpenMP's threads wait for each other at the end of each
/// loop, also for those that have not begun: where another program has the processor, each loop takes as long as the
/// scheduler lets it wait (a run of 1 s took 16 s on two busy processors). Here the calling thread takes all turns that
/// no helper has taken, and waits for taken ones only.
class Team {
 public:
  /// With fewer threads where the system gives no more: the caller takes their turns.
  explicit Team(int threads) : threads_(threads) {
    try {
      for (int i = 1; i < threads; ++i) helpers_.emplace_back([this] { help(); });
    } catch (const std::system_error&) {
    }
  }
  ~Team() {
    stops_ = true;
    open_.fetch_add(kEpoch);
    open_.notify_all();
    for (std::thread& helper : helpers_) helper.join();
  }
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  int threads() const { return threads_; }  ///< that were wanted

  void loop(std::size_t n, void (*turn)(void*, std::size_t), void* context) {
    turn_ = turn, context_ = context, n_ = n;
    done_.store(0, std::memory_order_relaxed);
    const std::uint64_t epoch = (open_.load(std::memory_order_relaxed) / kEpoch + 1) * kEpoch;
    open_.store(epoch + n, std::memory_order_release);
    open_.notify_all();
    takeTurns();
    for (int look = 0; done_.load(std::memory_order_acquire) < n; ++look) {
      look < kLooks ? pause() : std::this_thread::yield();
    }
  }

 private:
  static constexpr std::uint64_t kEpoch = std::uint64_t{1} << 32;

  // Takes turns until all are taken. Who has taken one may read the loop's members: the loop ends when it is done.
  void takeTurns() {
    std::uint64_t open = open_.load(std::memory_order_acquire);
    while (open % kEpoch > 0) {
      if (!open_.compare_exchange_weak(open, open - 1, std::memory_order_acq_rel, std::memory_order_acquire)) continue;
      turn_(context_, n_ - static_cast<std::size_t>(open % kEpoch));
      done_.fetch_add(1, std::memory_order_release);
      open = open_.load(std::memory_order_acquire);
    }
  }

  void help() {
    in_loop = true;
    while (!stops_) {
      std::uint64_t open = open_.load(std::memory_order_acquire);
      for (int look = 0; look < kLooks && open % kEpoch == 0 && !stops_; ++look) {
        pause();
        open = open_.load(std::memory_order_acquire);
      }
      if (open % kEpoch == 0 && !stops_) open_.wait(open, std::memory_order_acquire);
      takeTurns();
    }
  }

  int threads_;
  // Of the present loop.
  void (*turn_)(void*, std::size_t) = nullptr;
  void* context_ = nullptr;
  std::size_t n_ = 0;
  std::atomic<std::uint64_t> open_ = 0;  // kEpoch times the number of the loop, plus the turns that nobody has taken
  std::atomic<std::size_t> done_ = 0;    // turns
  std::atomic<bool> stops_ = false;
  std::vector<std::thread> helpers_;
};

}  // namespace

void onTeam(int threads, std::size_t n, void (*turn)(void*, std::size_t), void* context) {
  if (in_loop || omp_in_parallel()) {
    for (std::size_t i = 0; i < n; ++i) turn(context, i);
    return;
  }
  thread_local std::unique_ptr<Team> team;
  if (!team || team->threads() != threads) {
    team.reset();
    team = std::make_unique<Team>(threads);
  }
  in_loop = true;
  team->loop(n, turn, context);
  in_loop = false;
}

}  // namespace irk::detail
