#include "experiments/own/stuck.h"

#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <csignal>
#include <string>
#include <thread>

#include "experiments/own/fixed_text.h"

namespace irk::own {
namespace {

std::atomic<int> silent = 0;                // seconds of CPU time
std::atomic<int> asks_at = 0, ends_at = 0;  // 0: never
std::atomic<int> patience = 0;              // seconds until it asks

FixedText question, end;

void onSecond(int) {
  const int now = silent.fetch_add(1, std::memory_order_relaxed) + 1;
  if (now == asks_at) {
    asks_at = 0;  // asked once
    question.print();
  }
  if (ends_at == 0 || now < ends_at) return;
  end.print();
  _exit(1);
}

}  // namespace

void askWhenStuck(const std::string& files, int seconds) {
  const std::string code = "code of " + files;
  question.set("irk: no step has ended for " + std::to_string(seconds) + " s of CPU time: does " + code +
               " not end? Ctrl-C, pressed twice, ends the program, as does a time limit of the run\n");
  end.set("irk: no step has ended for far longer than the run's time limit, as if " + code +
          " did not end: the program ends; what was finished before is kept\n");
  silent = 0;
  asks_at = patience = seconds;
  struct sigaction action = {};
  action.sa_handler = onSecond;
  action.sa_flags = SA_RESTART | SA_ONSTACK;
  sigaction(SIGPROF, &action, nullptr);
  const itimerval each_second{{1, 0}, {1, 0}};
  setitimer(ITIMER_PROF, &each_second, nullptr);
}

void stillGoing(double time_limit) {
  constexpr double kMost = 1e6;  // seconds
  static const int processors = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  const int more = static_cast<int>(std::ceil(std::min(time_limit, kMost))) * processors;
  ends_at.store(time_limit > 0 ? patience + more : 0, std::memory_order_relaxed);
  silent.store(0, std::memory_order_relaxed);
}

}  // namespace irk::own
