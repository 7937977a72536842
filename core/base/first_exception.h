// Carries exceptions out of loops over threads.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <limits>
#include <mutex>

namespace irk {

/// An exception that leaves a parallel region ends the program. A loop over threads therefore makes its turns by `run`,
/// and `rethrow` behind the loop throws what one thread would have thrown: the exception of the first turn with one.
///
///   FirstException first;
///   #pragma omp parallel for num_threads(threads)
///   for (std::size_t i = 0; i < n; ++i) first.run(i, [&] { work(i); });
///   first.rethrow();
class FirstException {
 public:
  /// Calls f() as turn i, unless an earlier turn has thrown: one thread would not have come to turn i.
  template <class F>
  void run(std::size_t i, F&& f) {
    if (i > turn_) return;
    try {
      f();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (i > turn_) return;
      turn_ = i;
      exception_ = std::current_exception();
    }
  }
  bool happened() const { return turn_ != kNone; }
  void rethrow() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::atomic<std::size_t> turn_ = kNone;
  std::mutex mutex_;
  std::exception_ptr exception_;
};

}  // namespace irk
