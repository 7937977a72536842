// Refuses a second call of an object while a call is under way.
#pragma once

#include <atomic>
#include <string>

#include "irk/misuse.h"

namespace irk {

/// Marks an object as in use as long as it lives. An integrator has one state: a call from a callback of its own call,
/// or from another thread, would overwrite it.
class InUse {
 public:
  /// Throws Misuse if the object is in use. `call`: for the message.
  InUse(std::atomic_flag& flag, const char* call) : flag_(flag) {
    if (!flag.test_and_set()) return;
    throw Misuse(
        std::string(call) +
        " is called while another call of the same object is under way: a callback, a system or another thread "
        "needs an object of its own");
  }
  ~InUse() { flag_.clear(); }
  InUse(const InUse&) = delete;
  InUse& operator=(const InUse&) = delete;

 private:
  std::atomic_flag& flag_;
};

}  // namespace irk
