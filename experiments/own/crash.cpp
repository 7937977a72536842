#include "experiments/own/crash.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <string>
#include <vector>

#include "experiments/base/failure.h"
#include "experiments/own/fixed_text.h"
#include "experiments/own/stuck.h"

namespace irk::own {
namespace {

FixedText of_crash, of_exit;

void onCrash(int) {
  of_crash.print();
  _exit(1);
}

std::atomic<bool> exit_is_mistake = false;

void onExit() {
  if (!exit_is_mistake) return;
  of_exit.print();
  _exit(1);
}

// A stack of its own: the crash may be that the stack is used up.
void useOwnStack() {
  static auto& memory = *new std::vector<char>(static_cast<std::size_t>(4 * SIGSTKSZ));
  const stack_t stack{.ss_sp = memory.data(), .ss_flags = 0, .ss_size = memory.size()};
  sigaltstack(&stack, nullptr);
}

}  // namespace

void explainCrashes(const std::filesystem::path& file) {
  const bool is_source = file.extension() == ".cpp";
  constexpr int kSilentSeconds = 20;  // far more than a step needs, but in large systems with many digits
  blameExceptionsOn(file.string());
  askWhenStuck(file, kSilentSeconds);
  of_exit.set("irk: code of " + file.string() + " called exit(); it has to return\n");
  std::string crash =
      "irk: the program crashed while it ran code of " + file.string() + ", most likely by " +
      (is_source ? "an index out of range or a null pointer" : "another calling sequence or an index out of range") +
      "; what was finished before is kept";
  crash += is_source && !wantsChecks() ? "; compiled with checks it tells the place: IRK_CHECKED=1 irk ...\n" : ".\n";
  of_crash.set(crash);
  static const bool installed = [] {
    useOwnStack();
    struct sigaction action = {};
    action.sa_handler = onCrash;
    action.sa_flags = SA_ONSTACK;
    for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT}) sigaction(signal, &action, nullptr);
    std::atexit(onExit);
    return true;
  }();
  static_cast<void>(installed);
}

ExitGuard::ExitGuard() { exit_is_mistake = true; }
ExitGuard::~ExitGuard() { allowExit(); }
void allowExit() { exit_is_mistake = false; }

bool wantsChecks() {
  const char* const value = std::getenv("IRK_CHECKED");
  return value && *value && std::string(value) != "0";
}

}  // namespace irk::own
