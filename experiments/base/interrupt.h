// Ctrl-C: the first one asks the program to stop after the current step, the second one kills it, as does the time.
#pragma once

#include <atomic>

namespace irk {

/// Set by SIGINT and SIGTERM while an InterruptScope exists. It is the only global state of the process: a signal
/// handler can reach nothing else.
const std::atomic<bool>& interruptFlag();

/// Handles SIGINT and SIGTERM while it exists; the destructor restores the default handlers. If it still exists 60 s
/// after the first signal, as where a user's code waits for ever, the program says so and ends with kInterruptedStatus:
/// a batch system sends one SIGTERM only. Uses SIGALRM. Do not nest.
class InterruptScope {
 public:
  InterruptScope();
  ~InterruptScope();
  InterruptScope(const InterruptScope&) = delete;
  InterruptScope& operator=(const InterruptScope&) = delete;
};

}  // namespace irk
