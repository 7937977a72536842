// Loops over threads that behave as loops of one thread.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <limits>
#include <mutex>

#include "irk/multiprecision.h"

namespace irk {

/// The turns of a parallel loop work in the digits of the thread that makes this object. An exception that leaves a
/// parallel region would end the program: `rethrow` behind the loop throws what one thread would have thrown, the
/// exception of the first turn with one.
///
///   ParallelLoop loop;
///   #pragma omp parallel for num_threads(threads)
///   for (std::size_t i = 0; i < n; ++i) loop.turn(i, [&] { work(i); });
///   loop.rethrow();
class ParallelLoop {
 public:
  /// Calls f() as turn i, unless an earlier turn has thrown: one thread would not have come to turn i.
  template <class F>
  void turn(std::size_t i, F&& f) {
    if (i > thrown_in_) return;
    const WorkingDigits digits(digits_);
    try {
      f();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (i > thrown_in_) return;
      thrown_in_ = i;
      exception_ = std::current_exception();
    }
  }
  bool hasThrown() const { return thrown_in_ != kNone; }
  void rethrow() const {
    if (exception_) std::rethrow_exception(exception_);
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  int digits_ = WorkingDigits::now();
  std::atomic<std::size_t> thrown_in_ = kNone;
  std::mutex mutex_;
  std::exception_ptr exception_;
};

}  // namespace irk
