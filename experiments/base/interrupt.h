// Ctrl-C: the first one asks everything to stop after the current step, the second one kills.
#pragma once

#include <atomic>

namespace irk {

/// Set by SIGINT and SIGTERM while an InterruptScope lives. The process' one piece of global state:
/// a signal handler can reach nothing else.
const std::atomic<bool>& interruptFlag();

/// Takes the signals over, and gives them back at its end. Do not nest.
class InterruptScope {
 public:
  InterruptScope();
  ~InterruptScope();
  InterruptScope(const InterruptScope&) = delete;
  InterruptScope& operator=(const InterruptScope&) = delete;
};

}  // namespace irk
