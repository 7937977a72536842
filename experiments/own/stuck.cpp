#include "experiments/own/stuck.h"

#include <sys/time.h>

#include <atomic>
#include <csignal>
#include <string>

#include "experiments/own/fixed_text.h"

namespace irk::own {
namespace {

std::atomic<int> silent = 0;  // seconds of CPU time
std::atomic<int> limit = 0;

FixedText message;

void onSecond(int) {
  if (silent.fetch_add(1, std::memory_order_relaxed) + 1 != limit) return;
  limit = 0;  // asked once
  message.print();
}

}  // namespace

void askWhenStuck(const std::filesystem::path& file, int seconds) {
  message.set("irk: no step has ended for " + std::to_string(seconds) + " s of CPU time: does code of " +
              file.string() + " not end? Ctrl-C, pressed twice, ends the program\n");
  silent = 0;
  limit = seconds;
  struct sigaction action = {};
  action.sa_handler = onSecond;
  action.sa_flags = SA_RESTART | SA_ONSTACK;
  sigaction(SIGPROF, &action, nullptr);
  const itimerval each_second{{1, 0}, {1, 0}};
  setitimer(ITIMER_PROF, &each_second, nullptr);
}

void stillGoing() { silent.store(0, std::memory_order_relaxed); }

}  // namespace irk::own
