#include "experiments/base/interrupt.h"

#include <unistd.h>

#include <csignal>
#include <string_view>

#include "experiments/base/streams.h"

namespace irk {
namespace {

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may not lock");

constexpr unsigned kPatience = 60;  // seconds

void onSignal(int signal) {
  interrupted.store(true, std::memory_order_relaxed);
  std::signal(signal, SIG_DFL);
  alarm(kPatience);
}

void onAlarm(int) {
  constexpr std::string_view kText =
      "irk: 60 s after the interrupt the program is still at work: it ends now; what was finished before is kept\n";
  const auto written = write(STDERR_FILENO, kText.data(), kText.size());
  static_cast<void>(written);  // nothing is left to be done
  _exit(kInterruptedStatus);
}

}  // namespace

const std::atomic<bool>& interruptFlag() { return interrupted; }

InterruptScope::InterruptScope() {
  interrupted.store(false);
  std::signal(SIGINT, onSignal);
  std::signal(SIGTERM, onSignal);
  std::signal(SIGALRM, onAlarm);
}

InterruptScope::~InterruptScope() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  alarm(0);
  std::signal(SIGALRM, SIG_DFL);
}

}  // namespace irk
