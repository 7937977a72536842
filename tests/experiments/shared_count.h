// A count that a test shares with its child processes.
#pragma once

#include <sys/mman.h>

#include <atomic>
#include <new>
#include <stdexcept>

namespace irk {

class SharedCount {
 public:
  SharedCount() : count_(*new (memory()) std::atomic<int>(0)) {}
  ~SharedCount() { munmap(&count_, sizeof count_); }
  SharedCount(const SharedCount&) = delete;
  SharedCount& operator=(const SharedCount&) = delete;

  /// The value before.
  int add() const { return count_.fetch_add(1); }
  int value() const { return count_; }

 private:
  static void* memory() {
    void* const memory =
        mmap(nullptr, sizeof(std::atomic<int>), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    return memory == MAP_FAILED ? throw std::runtime_error("no shared memory") : memory;
  }
  std::atomic<int>& count_;
};

}  // namespace irk
